;; :sort-by and :first.
;; plan nearest: (!go well)
;; plan farthest: (!go hill)
;; plan nearest-open: (!go hill)
;; plan first-only: none

(defdomain sorting (

(:operator (!go ?place) ((open ?place)) () ())

(:method (nearest) (:sort-by ?d (distance ?place ?d)) ((!go ?place)))
(:method (farthest) (:sort-by ?d #'> (distance ?place ?d)) ((!go ?place)))
(:method (any) (:first (distance ?place ?_)) ((!go ?place)))

))

(defproblem nearest sorting
 ((distance hill 30) (distance well 10) (distance barn 20) (open hill) (open well)) ((nearest)))
(defproblem farthest sorting
 ((distance well 10) (distance hill 30) (distance barn 20) (open hill) (open well)) ((farthest)))
;; The nearest is tried first, the others on backtracking.
(defproblem nearest-open sorting ((distance hill 30) (distance well 10) (open hill)) ((nearest)))
;; :first gives the first solution and no other.
(defproblem first-only sorting ((distance hill 30) (distance well 10) (open well)) ((any)))
