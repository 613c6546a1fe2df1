;; A rover collects samples and takes pictures, in the manner of the rovers domain of the International
;; Planning Competition, but on real ground: what is visible from where is not a list of facts that
;; somebody has written down, it follows from the rocks in world.yaml.

(defdomain samples (

;; The arm takes a sample that lies just ahead; it goes into a free compartment of the store.
(Operator (!collect ?r ?sample ?compartment)
  ( (rover ?r)(sample ?sample)(compartment_of ?compartment ?r)(free ?compartment) )
  ((agent ?r)(object ?sample)
   (distance(?r, ?sample) >= 2)
   (distance(?r, ?sample) <= 3)
   (field_of_view(?r, ?sample, deg(40))))
  ( (holds ?compartment ?sample)(not (free ?compartment)) ))

;; The lander's crane reaches the store, which is at the rover's back; it empties one compartment.
(Operator (!deliver ?r ?compartment ?sample ?lander)
  ( (lander ?lander)(compartment_of ?compartment ?r)(holds ?compartment ?sample) )
  ((agent ?r)(object ?lander)
   (distance(?r, ?lander) <= 6)
   (angle_between(rel_angle(?r, ?lander), pi) <= deg(20)))
  ( (delivered ?sample)(free ?compartment)(not (holds ?compartment ?sample)) ))

;; A camera is calibrated on a target that it sees, and is calibrated for one image only.
(Operator (!calibrate ?r ?camera ?target)
  ( (on_board ?camera ?r)(calibration_target ?camera ?target)(not (calibrated ?camera)) )
  ((agent ?r)(object ?target)
   (distance(?r, ?target) >= 4)
   (distance(?r, ?target) <= 25)
   (field_of_view(?r, ?target, deg(30)))
   (visible(?r, ?target)))
  ( (calibrated ?camera) ))

;; The camera on the mast looks ahead.  Each objective says itself from how far it can be seen (`range`).
(Operator (!take_image ?r ?objective ?mode ?camera)
  ( (objective ?objective)(memory_free ?r)
    (on_board ?camera ?r)(supports ?camera ?mode)(calibrated ?camera) )
  ((agent ?r)(object ?objective)
   (distance(?r, ?objective) >= 10)
   (distance(?r, ?objective) <= ?objective.range)
   (field_of_view(?r, ?objective, deg(40)))
   (visible(?r, ?objective)))
  ( (has_image ?r ?objective ?mode)(not (calibrated ?camera))(not (memory_free ?r)) ))

;; The radio needs the lander in sight; it does not matter where the rover looks.
(Operator (!send ?r ?objective ?mode ?lander)
  ( (lander ?lander)(has_image ?r ?objective ?mode) )
  ((agent ?r)(object ?lander)
   (distance(?r, ?lander) <= 80)
   (visible(?r, ?lander)))
  ( (received ?objective ?mode)(memory_free ?r)(not (has_image ?r ?objective ?mode)) ))

;; The goals of a problem, in whatever order is best.
(:method (achieve-goals (list . ?goals))
  ()
  ((achieve-in-any-order ?goals) (empty-store)))

(:method (achieve-in-any-order nil) () ())
(:method (achieve-in-any-order (?goal . ?goals))
  ()
  (:unordered (achieve ?goal) (achieve-in-any-order ?goals)))

;; A sample is collected when there is room for it.  When there is none, the store is emptied first.
(:method (achieve (delivered ?sample))
  there-is-room
  ((rover ?r)(compartment_of ?compartment ?r)(free ?compartment))
  ((!collect ?r ?sample ?compartment))
  the-store-is-full
  ()
  ((empty-store) (achieve (delivered ?sample))))

;; An image takes a camera that supports its mode and has been calibrated; it is sent before the next
;; one is taken.  :immediate keeps image and camera together: no other goal gets in between.
(:method (achieve (received ?objective ?mode))
  ((supports ?camera ?mode)(on_board ?camera ?r)(lander ?lander))
  ((make-ready ?r ?camera)
   (:immediate !take_image ?r ?objective ?mode ?camera)
   (!send ?r ?objective ?mode ?lander)))

(:method (make-ready ?r ?camera)
  already-calibrated
  ((calibrated ?camera))
  ()
  look-at-a-target
  ((calibration_target ?camera ?target))
  ((!calibrate ?r ?camera ?target)))

;; What is in the store is delivered, compartment by compartment.
(:method (empty-store)
  something-in-it
  ((:first (holds ?compartment ?sample) (compartment_of ?compartment ?r) (lander ?lander)))
  ((!deliver ?r ?compartment ?sample ?lander) (empty-store))
  empty
  ()
  ())

))
