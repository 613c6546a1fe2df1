;; Effects for all that fit, conditional effects, variables as add and delete lists, single facts from variables.
;; plan sweep: (!sweep hall) (!done 0)
;; plan sweep-again: (!sweep hall) (!done 1)
;; plan swap: (!change ((wet floor) (open door)) ((dry floor))) (!check)
;; plan note: (!!note (seen fox)) (!tell fox)

(defdomain effects (

(:operator (!sweep ?room)
 ()
 ((forall (?x) ((in ?x ?room) (loose ?x)) ((in ?x ?room))))
 ((forall (?x) ((in ?x ?room) (loose ?x)) ((in ?x bin)))
  (when (in cat ?room) ((asleep cat)))))
(:operator (!done ?left) () () ())
(:method (clean ?room)
 () ((!sweep ?room) (count ?room)))
(:method (count ?room)
 some
 ((bagof ?x (in ?x ?room) ?all) (asleep cat)) ((!done (call length ?all)))
 none
 ((not (in ?_ ?room)) (not (asleep cat)) (in dust bin)) ((!done 0)))

(:operator (!change ?old ?new) () ?old ?new)
(:operator (!check) ((dry floor) (not (wet floor)) (not (open door))) () ())
(:method (swap) () ((!change ((wet floor) (open door)) ((dry floor))) (!check)))

(:operator (!!note ?fact) () () (?fact))
(:operator (!tell ?animal) ((seen ?animal)) () ())
(:method (watch) () ((!!note (seen fox)) (!tell ?_animal)))

))

(defproblem sweep effects ((in dust hall) (loose dust)) ((clean hall)))
(defproblem sweep-again effects ((in dust hall) (loose dust) (in cat hall)) ((clean hall)))
(defproblem swap effects ((wet floor) (open door)) ((swap)))
(defproblem note effects () ((watch)))
