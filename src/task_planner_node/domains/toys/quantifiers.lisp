;; forall, exists, imply, not, setof and bagof.
;; plan all-packed: (!leave (lamp tent))
;; plan one-missing: (!stay)
;; plan count: (!report 2 3)
;; plan nothing: none

(defdomain quantifiers (

(:operator (!leave ?bag) () () ())
(:operator (!stay) () () ())
(:operator (!report ?kinds ?items) () () ())

(:method (set-out)
 ready
 ((forall (?x) (needed ?x) (packed ?x))
  (imply (raining) (packed coat))
  (exists (?x) (packed ?x))
  (setof ?x (packed ?x) ?bag))
 ((!leave ?bag))
 not-ready
 ((not (forall (?x) (needed ?x) (packed ?x))))
 ((!stay)))

(:method (count)
 ((setof ?kind (item ?_ ?kind) ?kinds) (bagof ?kind (item ?_ ?kind) ?all))
 ((!report (call length ?kinds) (call length ?all))))

))

(defproblem all-packed quantifiers ((needed tent) (packed lamp) (packed tent)) ((set-out)))
(defproblem one-missing quantifiers ((needed tent) (needed lamp) (packed lamp) (raining)) ((set-out)))
(defproblem count quantifiers ((item 1 cup) (item 2 pot) (item 3 cup)) ((count)))
;; Without any item setof has no solution.
(defproblem nothing quantifiers () ((count)))
