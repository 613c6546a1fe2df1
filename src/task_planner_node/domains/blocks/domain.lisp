;; Blocks on a table, moved by a gripper.  (goal-on a b) and (goal-on-table a) say how they shall stand in the end.
;; A block is moved when it can go where it stays; only if none can, one that is in the way is put on the table.

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

(:method (arrange)
 to-its-place
 (:first (clear ?block) (goal-on ?block ?below) (clear ?below) (not (on ?block ?below)) (settled ?below))
 ((take ?block) (!stack ?block ?below) (arrange))
 out-of-the-way
 (:first (clear ?block) (on ?block ?below) (not (settled ?block)))
 ((!unstack ?block ?below) (!put-down ?block) (arrange))
 done
 ()
 ())

(:method (take ?block)
 from-the-table
 ((on-table ?block))
 ((!pick-up ?block))
 from-another
 ((on ?block ?below))
 ((!unstack ?block ?below)))

;; A block is settled when it and all below it stand where they stay.
(:- (settled ?block)
 on-the-table
 ((on-table ?block) (not (goal-on ?block ?_)))
 on-another
 ((on ?block ?below) (not (misplaced ?block ?below)) (settled ?below)))

(:- (misplaced ?block ?below)
 wanted-elsewhere
 ((goal-on ?block ?other) (not (same ?other ?below)))
 wanted-on-the-table
 ((goal-on-table ?block))
 in-the-place-of-another
 ((goal-on ?other ?below) (not (same ?other ?block))))

(:- (same ?x ?x) ())

))
