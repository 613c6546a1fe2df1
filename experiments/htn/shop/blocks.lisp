;; The blocks of src/task_planner_node/domains/blocks for large problems: facts about what may be moved are kept up to
;; date, so that a move takes the same time however many blocks there are.
;;
;; (settled b): b and all below it stand where they stay.  (ready b d): b can go to d, where it stays.
;; (waiting b): b is free, has to leave its place, and cannot go where it stays yet.

(defdomain blocks (

(:op (!pick-up ?block)
 :precond ((on-table ?block) (clear ?block))
 :delete ((on-table ?block) (clear ?block))
 :add ((holding ?block)))

(:op (!put-down ?block)
 :precond ((holding ?block))
 :delete ((holding ?block))
 :add ((on-table ?block) (clear ?block)))

(:op (!unstack ?block ?below)
 :precond ((on ?block ?below) (clear ?block))
 :delete ((on ?block ?below) (clear ?block))
 :add ((holding ?block) (clear ?below)))

(:op (!stack ?block ?below)
 :precond ((holding ?block) (clear ?below))
 :delete ((holding ?block) (clear ?below))
 :add ((on ?block ?below) (clear ?block)))

(:op (!!settle ?block)
 :delete ((waiting ?block))
 :add ((settled ?block)) :cost 0)

(:op (!!go-ahead ?block ?place)
 :delete ((waiting ?block))
 :add ((ready ?block ?place)) :cost 0)

(:op (!!wait ?block) :add ((waiting ?block)) :cost 0)

(:op (!!begin ?block ?place) :delete ((ready ?block ?place)) :cost 0)

(:op (!!clear-the-way ?block) :delete ((waiting ?block)) :cost 0)

(:method (arrange)
 ((setof ?block (on-table ?block) ?lowest) (setof ?top (clear ?top) ?free))
 ((settle-towers ?lowest) (look-at-all ?free) (move-all)))

;; What stands where it stays already.
(:method (settle-towers ?blocks)
 ((assign* ?block ?blocks) (not (goal-on ?block ?_)) (not (settled ?block)))
 ((settle-up ?block) (settle-towers ?blocks))
 ()
 ())

(:method (settle-up ?block)
 higher
 ((on ?above ?block) (goal-on ?above ?block))
 ((!!settle ?block) (settle-up ?above))
 highest
 ()
 ((!!settle ?block)))

(:method (look-at-all nil) () ())
(:method (look-at-all (?block . ?others))
 ()
 ((look-at ?block) (look-at-all ?others)))

;; What a free block can do.
(:method (look-at ?block)
 stays
 ((settled ?block) (goal-on ?above ?block) (clear ?above))
 ((!!go-ahead ?above ?block))
 stays-alone
 ((settled ?block))
 ()
 to-another
 ((goal-on ?block ?below) (settled ?below) (clear ?below))
 ((!!go-ahead ?block ?below))
 to-the-table
 ((on ?block ?_) (not (goal-on ?block ?_)))
 ((!!go-ahead ?block table))
 blocked
 ((on ?block ?_))
 ((!!wait ?block))
 on-the-table
 ()
 ())

(:method (move-all)
 to-its-place
 (:first (ready ?block ?place))
 ((!!begin ?block ?place) (take ?block) (put ?block ?place) (move-all))
 off-one-that-can-go
 (:first (waiting ?block) (on ?block ?below) (goal-on ?below ?place) (settled ?place) (clear ?place))
 ((!!clear-the-way ?block) (!unstack ?block ?below) (!put-down ?block) (look-at ?below) (move-all))
 off-the-place-of-another
 (:first (waiting ?block) (on ?block ?below) (settled ?below))
 ((!!clear-the-way ?block) (!unstack ?block ?below) (!put-down ?block) (look-at ?below) (move-all))
 out-of-the-way
 (:first (waiting ?block) (on ?block ?below))
 ((!!clear-the-way ?block) (!unstack ?block ?below) (!put-down ?block) (look-at ?below) (move-all))
 done
 ()
 ())

(:method (take ?block)
 from-the-table
 ((on-table ?block))
 ((!pick-up ?block))
 from-another
 ((on ?block ?below))
 ((!unstack ?block ?below) (look-at ?below)))

(:method (put ?block table)
 ()
 ((!put-down ?block) (!!settle ?block) (look-at ?block)))
(:method (put ?block ?below)
 ((goal-on ?block ?below))
 ((!stack ?block ?below) (!!settle ?block) (look-at ?block)))

))
