;; Ordered and unordered tasks, nested, and immediate ones.
;; plan interleave: (!open) (!take) (!close)
;; plan in-order: none
;; plan at-once: (!a) (!c) (!b)
;; plan not-at-once: (!a) (!b) (!c)
;; plan nested: (!a) (!open) (!b) (!take) (!c) (!close)

(defdomain ordering (

(:operator (!open) ((not (is-open))) () ((is-open)))
(:operator (!take) ((is-open)) () ((taken)))
(:operator (!close) ((is-open) (taken)) ((is-open)) ())
(:operator (!a) () () ((a)))
(:operator (!b) ((a)) () ((b)))
(:operator (!c) ((a)) () ((c)))

(:method (interleave) () (:unordered (:ordered (!open) (!close)) (!take)))
(:method (in-order) () (:ordered (:ordered (!open) (!close)) (!take)))
(:method (at-once) () (:unordered (:ordered (!a) (!b)) (:ordered (then-c))))
(:method (then-c) ((a)) ((:immediate !c)))
(:method (plain) () (:unordered (:ordered (!a) (!b)) (:ordered (!c))))
(:method (nested)
 ()
 ((!a) (:unordered (:ordered (!open) (finish)) (!b))))
(:method (finish) ((b)) ((!take) (!c) (!close)))

))

(defproblem interleave ordering () ((interleave)))
(defproblem in-order ordering () ((in-order)))
(defproblem at-once ordering () (:ordered (!a) (:unordered (!b) (:immediate !c))))
(defproblem not-at-once ordering () ((plain)))
(defproblem nested ordering () ((nested)))
