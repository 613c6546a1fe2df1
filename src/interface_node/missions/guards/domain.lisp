;; A guard tour in pairs.  A walker checks gates, one after the other, and a patrol car covers it: before
;; the walker goes to a gate, the car stands where it overlooks the gate, and while the walker is at the
;; gate each has the other in view.  Constraints may name several agents: the one that is stated first
;; moves, the others stand where the actions before have left them.

(defdomain guards (

;; The car takes a place from which it overlooks a gate, and keeps clear of the walker.
(Operator (!cover ?car ?gate ?walker)
  ( (covers ?car ?walker)(gate ?gate)(not (covered ?gate)) )
  ((agent ?car)(agent ?walker)(object ?gate)
   (distance(?car, ?gate) >= 6)
   (distance(?car, ?gate) <= 16)
   (field_of_view(?car, ?gate, deg(70)))
   (visible(?car, ?gate))
   (distance(?car, ?walker) >= 3))
  ( (covered ?gate) ))

;; The walker moves, the car stands still; so the car's view is a constraint on where the walker stands.
(Operator (!check_gate ?walker ?gate ?car)
  ( (covers ?car ?walker)(gate ?gate)(covered ?gate) )
  ((agent ?walker)(agent ?car)(object ?gate)
   (distance(?walker, ?gate) >= 0.6)
   (distance(?walker, ?gate) <= 1.5)
   (facing(?walker, ?gate))
   (visible(?walker, ?gate))
   (visible(?walker, ?car))
   (field_of_view(?car, ?walker, deg(90)))
   (distance(?walker, ?car) >= 5)
   (distance(?walker, ?car) <= 18))
  ( (checked ?gate)(not (covered ?gate)) ))

;; The key of the vault hangs in the office.
(Operator (!fetch_key ?walker ?box ?key)
  ( (hangs ?key ?box) )
  ((agent ?walker)(object ?box)
   (distance(?walker, ?box) >= 0.6)
   (distance(?walker, ?box) <= 1)
   (facing(?walker, ?box))
   (visible(?walker, ?box)))
  ( (has_key ?walker ?key)(not (hangs ?key ?box)) ))

(Operator (!return_key ?walker ?box ?key)
  ( (has_key ?walker ?key) )
  ((agent ?walker)(object ?box)
   (distance(?walker, ?box) >= 0.6)
   (distance(?walker, ?box) <= 1)
   (facing(?walker, ?box))
   (visible(?walker, ?box)))
  ( (hangs ?key ?box)(not (has_key ?walker ?key)) ))

;; At the end the two stand side by side at their post: the car parks in the middle of it, and the
;; walker comes to its left, looking the same way.
(Operator (!fall_in ?car ?walker ?parking)
  ( (covers ?car ?walker)(parking ?parking) )
  ((agent ?car)(region ?parking)
   (inside(?car, ?parking)))
  ( (at_post ?car) ))

(Operator (!stand_beside ?walker ?car ?post)
  ( (post ?post)(at_post ?car) )
  ((agent ?walker)(agent ?car)(region ?post)
   (inside(?walker, ?post))
   (distance(?walker, ?car) = 2.5)
   (object_on_right(?walker, ?car))
   (same_heading(?walker, ?car)))
  ( (at_post ?walker) ))

(:method (patrol ?_car ?_walker nil) () ())
(:method (patrol ?car ?walker (?gate . ?others))
  ()
  (:unordered (secure ?car ?walker ?gate) (patrol ?car ?walker ?others)))

;; A pair works on one gate at a time: :immediate keeps the two actions together.
(:method (secure ?car ?walker ?gate)
  a-locked-gate
  ((locked_with ?gate ?key)(hangs ?key ?box))
  ((!fetch_key ?walker ?box ?key) (secure ?car ?walker ?gate))
  any-other
  ()
  ((!cover ?car ?gate ?walker) (:immediate !check_gate ?walker ?gate ?car)))

))
