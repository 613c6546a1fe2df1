;; Branches of a method are tried in order and only the first that fits; several methods are alternatives.
;; plan fork: (!eat fork)
;; plan spoon: (!eat spoon)
;; plan no-fork-left: none
;; plan other-method: (!drink)
;; plan old-form: (!put x) (!get x 3)

(defdomain branches (

(:operator (!eat ?with) ((clean ?with)) () ())
(:operator (!drink) () () ())
;; The old form without preconditions, and with a cost.
(:operator (!put ?x) () ((there ?x)))
(:operator (!get ?x ?n) ((there ?x)) () 3)

(:method (eat)
 with-a-fork ((have fork)) ((!eat fork))
 with-a-spoon ((have spoon)) ((!eat spoon)))
(:method (live) () ((eat)))
(:method (live) () ((!drink)))
(:method old (old) () ((!put x) (!get x 3)))

))

(defproblem fork branches ((have fork) (have spoon) (clean fork)) ((eat)))
(defproblem spoon branches ((have spoon) (clean spoon)) ((eat)))
;; The first branch fits, so the second is not tried although it would do.
(defproblem no-fork-left branches ((have fork) (have spoon) (clean spoon)) ((eat)))
(defproblem other-method branches ((have fork)) ((live)))
(defproblem old-form branches () ((old)))
