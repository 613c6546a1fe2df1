;; A protected fact stays true until the protection is taken back as often as it was given.
;; plan safe: (!hold) (!release) (!drop)
;; plan held: none
;; plan held-twice: none
;; plan kept-away: none
;; plan let-in: (!guard) (!relax) (!enter)

(defdomain protections (

(:operator (!hold) () () ((:protection (standing))))
(:operator (!release) () ((:protection (standing))) ())
(:operator (!drop) () ((standing)) ())
(:operator (!guard) () () ((:protection (not (inside)))))
(:operator (!relax) () ((:protection (not (inside)))) ())
(:operator (!enter) () () ((inside)))

))

(defproblem safe protections ((standing)) ((!hold) (!release) (!drop)))
(defproblem held protections ((standing)) ((!hold) (!drop)))
(defproblem held-twice protections ((standing)) ((!hold) (!hold) (!release) (!drop)))
(defproblem kept-away protections () ((!guard) (!enter)))
(defproblem let-in protections () ((!guard) (!relax) (!enter)))
