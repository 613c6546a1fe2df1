;; The rover domain of Guitton and Farges: two operators, as printed in their
;; Figures 2 and 3, and the methods that lead from goals to photos.

(defdomain rover (

;; Operator !init rover attitude
(Operator (!init_rover_attitude ?r ?o)

;; symbolic preconditions
( (location ?o)(not(initialized ?r)) )

;; geometric preconditions
((agent ?r)(object ?o)
(setProperty(?r.x,?o.x))
(setProperty(?r.y,?o.y))
(setProperty(?r.heading,0)))

;; symbolic effects
( (initialized ?r) )

)

;; Operator !take photo
(Operator (!take_photo ?r ?o ?c)

;; symbolic preconditions
( (rover ?r)(available ?r)

(location ?o)(need_photo_of ?o)
(has_camera ?r ?c) )

;; geometric preconditions
((agent ?r)(object ?o)
(distance(?r, ?o) >= 50)
(distance(?r, ?o) <= 100)
(rel_angle(?r,?o) = cos-and-sin(pi/2)))

;; symbolic effects
( (has_photo_of ?r ?o) )

)

;; What has to be photographed follows from the goals.  An operator whose name
;; begins with !! is internal: it changes the state and is no action of the plan.
(:operator (!!need_photo ?o)
  ()
  ()
  ((need_photo_of ?o)))

;; Goals are noted first and then achieved in whatever order is best.
(:method (achieve-goals (list . ?goals))
  ()
  ((note-goals ?goals) (achieve-in-any-order ?goals)))

(:method (note-goals nil)
  ()
  ())

(:method (note-goals ((has_photo_of ?_robot ?o) . ?goals))
  ()
  ((!!need_photo ?o) (note-goals ?goals)))

(:method (achieve-in-any-order nil)
  ()
  ())

(:method (achieve-in-any-order (?goal . ?goals))
  ()
  (:unordered (achieve ?goal) (achieve-in-any-order ?goals)))

(:method (achieve (has_photo_of ?r ?o))
  already-achieved
  ((has_photo_of ?r ?o))
  ()
  photograph
  ((has_camera ?r ?c))
  ((!take_photo ?r ?o ?c)))

))
