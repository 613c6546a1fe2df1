;; Rovers take soil samples and photos and send the results to a lander.  Where there is a choice the nearest one is tried
;; first: (hops a b n) says that b is n moves away from a, along (way a b).

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

(:method (investigate)
 next-one
 (:first (wanted ?result) (not (received ?result)))
 ((get ?result) (investigate))
 done
 ()
 ())

(:method (get (soil-of ?place))
 (:sort-by ?hops ((has-drill ?rover) (at ?rover ?here) (distance ?here ?place ?hops)))
 ((go ?rover ?place) (make-room ?rover) (!sample ?rover ?place) (report ?rover (soil-of ?place))))

(:method (get (image-of ?objective ?mode))
 (:sort-by ?hops
  ((supports ?camera ?mode) (camera ?camera ?rover) (at ?rover ?here)
   (visible ?objective ?place) (distance ?here ?place ?hops)))
 ((go ?rover ?place)
  (!take-image ?rover ?camera ?objective ?mode)
  (report ?rover (image-of ?objective ?mode))))

(:method (make-room ?rover)
 ((store-empty ?rover))
 ()
 ()
 ((!empty-store ?rover)))

(:method (report ?rover ?result)
 (:sort-by ?hops ((at ?rover ?here) (lander-visible ?place) (distance ?here ?place ?hops)))
 ((go ?rover ?place) (!send ?rover ?result)))

;; One step at a time, always nearer to the goal.
(:method (go ?rover ?place)
 ((at ?rover ?place))
 ()
 (:first (at ?rover ?here) (distance ?here ?place ?hops)
  (way ?here ?next) (distance ?next ?place ?fewer) (call < ?fewer ?hops))
 ((!navigate ?rover ?here ?next) (go ?rover ?place)))

(:- (distance ?place ?place 0) ())
(:- (distance ?from ?to ?hops) ((hops ?from ?to ?hops)))

))
