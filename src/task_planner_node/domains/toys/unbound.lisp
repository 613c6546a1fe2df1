;; A variable of a task that nothing has bound yet is bound by what comes first.
;; plan fetch: (!choose 2) (!use 2)
;; plan synthetic: (!measure 30) (!report 30)
;; plan asked: (!choose 1)

(defdomain unbound (

(:operator (!choose ?x) ((offered ?x)) () ())
(:operator (!use ?x) ((fits ?x)) () ())
(:operator (!measure ?t) ((time ?t)) () ())
(:operator (!report ?t) () () ())

(:method (fetch) () ((!choose ?x) (!use ?x)))
(:method (observe) () ((look ?t) (!report ?t)))
(:method (look ?t) () ((!measure ?t)))

))

(defproblem fetch unbound ((offered 1) (offered 2) (fits 2)) ((fetch)))
(defproblem synthetic unbound ((time 30)) ((observe)))
(defproblem asked unbound ((offered 1)) ((!choose ?x)))
