;; A guard tour in pairs.  A walker checks gates, one after the other, and a patrol car covers it: before
;; the walker touches a gate, the car stands where it sees both the gate and the walker, and while the
;; walker is at the gate it stays in the car's view.  Constraints may name several agents: the one that is
;; stated first moves, the others stand where the actions before have left them.

(defdomain guards (

;; The car takes a post from which it overlooks a gate and has the walker in sight.
(Operator (!cover ?car ?gate ?walker)
  ( (covers ?car ?walker)(gate ?gate)(not (covered ?gate)) )
  ((agent ?car)(agent ?walker)(object ?gate)
   (distance(?car, ?gate) >= 6)
   (distance(?car, ?gate) <= 16)
   (field_of_view(?car, ?gate, deg(70)))
   (visible(?car, ?gate))
   (visible(?car, ?walker))
   (distance(?car, ?walker) >= 3))
  ( (covered ?gate) ))

;; The walker moves, the car stands still; so the car's view is a constraint on where the walker stands.
(Operator (!check_gate ?walker ?gate ?car)
  ( (covers ?car ?walker)(gate ?gate)(covered ?gate) )
  ((agent ?walker)(agent ?car)(object ?gate)
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
   (distance(?walker, ?box) <= 1)
   (facing(?walker, ?box))
   (visible(?walker, ?box)))
  ( (has_key ?walker ?key)(not (hangs ?key ?box)) ))

(Operator (!return_key ?walker ?box ?key)
  ( (has_key ?walker ?key) )
  ((agent ?walker)(object ?box)
   (distance(?walker, ?box) <= 1)
   (facing(?walker, ?box))
   (visible(?walker, ?box)))
  ( (hangs ?key ?box)(not (has_key ?walker ?key)) ))

;; At the end the two stand side by side at their post, the car on the walker's right.
(Operator (!fall_in ?car ?walker ?post)
  ( (covers ?car ?walker)(post ?post) )
  ((agent ?car)(region ?post)
   (inside(?car, ?post)))
  ( (at_post ?car) ))

(Operator (!stand_beside ?walker ?car ?post)
  ( (at_post ?car) )
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
