;; Axioms: several bodies, of which the first that holds counts, recursion, and axioms as definitions of equality.
;; plan reach: (!go d)
;; plan nowhere: none
;; plan by-car: (!travel car)
;; plan on-foot: (!travel feet)
;; plan member: (!take pear)

(defdomain axioms (

(:operator (!go ?place) () () ())
(:operator (!travel ?how) () () ())
(:operator (!take ?x) ((ripe ?x)) () ())

(:method (visit ?from ?to) ((reachable ?from ?to)) ((!go ?to)))
(:method (travel) ((means ?how)) ((!travel ?how)))
(:method (take-one-of ?list) ((among ?x ?list)) ((!take ?x)))

(:- (reachable ?x ?x) ())
(:- (reachable ?x ?z) ((way ?x ?y) (reachable ?y ?z)))

;; Feet do not count where there is a car.
(:- (means ?how)
 motor ((car) (same ?how car))
 legs ((same ?how feet)))
(:- (same ?x ?x) ())

(:- (among ?x (?x . ?_)) ())
(:- (among ?x (?_ . ?rest)) ((among ?x ?rest)))

))

(defproblem reach axioms ((way a b) (way b c) (way c d)) ((visit a d)))
(defproblem nowhere axioms ((way a b) (way c d)) ((visit a d)))
(defproblem by-car axioms ((car)) ((travel)))
(defproblem on-foot axioms () ((travel)))
(defproblem member axioms ((ripe pear)) ((take-one-of (apple pear plum))))
