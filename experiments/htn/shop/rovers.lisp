;; The rovers of src/task_planner_node/domains/rovers for large problems: the way to every place is looked up.
;;
;; (route a b n c): b is n moves away from a, and c is the first place on the way there.
;; (base a b): of the places where the lander is seen, b is the nearest to a.

(defdomain rovers (

(:op (!navigate ?rover ?from ?to)
 :precond ((at ?rover ?from) (way ?from ?to))
 :delete ((at ?rover ?from))
 :add ((at ?rover ?to)))

(:op (!sample ?rover ?place)
 :precond ((at ?rover ?place) (soil ?place) (has-drill ?rover) (store-empty ?rover))
 :delete ((store-empty ?rover))
 :add ((has-sample ?rover ?place)))

(:op (!empty-store ?rover)
 :precond ((not (store-empty ?rover)))
 :add ((store-empty ?rover)))

(:op (!take-image ?rover ?camera ?objective ?mode)
 :precond ((at ?rover ?place) (visible ?objective ?place) (camera ?camera ?rover) (supports ?camera ?mode))
 :add ((has-image ?rover ?objective ?mode)))

(:op (!send ?rover ?result)
 :precond ((at ?rover ?place) (lander-visible ?place))
 :add ((received ?result)))

(:op (!!take-on ?result) :delete ((wanted ?result)) :cost 0)

(:method (investigate)
 next-one
 (:first (wanted ?result))
 ((!!take-on ?result) (get ?result) (investigate))
 done
 ()
 ())

(:method (get (soil-of ?place))
 (:sort-by ?hops ((has-drill ?rover) (at ?rover ?here) (route ?here ?place ?hops ?_)))
 ((go ?rover ?place) (make-room ?rover) (!sample ?rover ?place) (report ?rover (soil-of ?place))))

(:method (get (image-of ?objective ?mode))
 (:sort-by ?hops
  ((supports ?camera ?mode) (camera ?camera ?rover) (at ?rover ?here)
   (visible ?objective ?place) (route ?here ?place ?hops ?_)))
 ((go ?rover ?place)
  (!take-image ?rover ?camera ?objective ?mode)
  (report ?rover (image-of ?objective ?mode))))

(:method (make-room ?rover)
 ((store-empty ?rover))
 ()
 ()
 ((!empty-store ?rover)))

(:method (report ?rover ?result)
 ((at ?rover ?here) (base ?here ?place))
 ((go ?rover ?place) (!send ?rover ?result)))

(:method (go ?rover ?place)
 ((at ?rover ?place))
 ()
 ((at ?rover ?here) (route ?here ?place ?_ ?next))
 ((!navigate ?rover ?here ?next) (go ?rover ?place)))

))
