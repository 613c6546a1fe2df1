;; Computing: assign, assign*, call, eval, computed arguments and costs.
;; plan add: (!say 5 t)
;; plan choose: (!pick 3)
;; plan compare: (!larger 7) (!say 7 larger)
;; plan lists: (!say (c b a) 3)
;; plan odd: none

(defdomain calls (

(:operator (!say ?what ?how) () () ())
(:operator (!pick ?n) ((number ?n)) () ())
(:operator (!larger ?n) () () () (* 2 ?n))

(:method (add ?a ?b)
 ((assign ?sum (+ ?a ?b)) (assign ?rounded (call = ?sum (call floor ?sum))))
 ((!say ?sum ?rounded)))

(:method (choose-above ?limit)
 ((assign* ?n '(1 2 3 4)) (call > ?n ?limit))
 ((!pick ?n)))

(:method (compare ?a ?b)
 first-is-larger
 ((eval (> ?a ?b)))
 ((!larger ?a) (!say ?a larger))
 second-is-larger
 ((eval (and (not (> ?a ?b)) (/= ?a ?b))))
 ((!larger ?b) (!say ?b larger)))

(:method (turn-round ?list)
 ()
 ((!say (call reverse ?list) (call length ?list))))

(:method (only-even ?n)
 ((eval (evenp ?n)))
 ((!pick ?n)))

))

(defproblem add calls () ((add 2 3)))
(defproblem choose calls ((number 1) (number 3) (number 4)) ((choose-above 2)))
(defproblem compare calls () ((compare 4 7)))
(defproblem lists calls () ((turn-round (a b c))))
(defproblem odd calls ((number 3)) ((only-even 3)))
