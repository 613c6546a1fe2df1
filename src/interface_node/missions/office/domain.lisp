;; An inspection round.  A robot with a camera reads gauges, which have to be looked at from the
;; front, and checks that fire extinguishers hang where they should, for which any clear view will do.
;; A room with an alarm is disarmed first, and armed again when everything in it has been seen.

(defdomain office (

;; The robot stands on its charger.  setProperty assigns an attitude, so nothing is driven here.
(Operator (!leave_charger ?r ?charger)
  ( (robot ?r)(charger ?charger)(charging ?r) )   ; symbolic preconditions
  ((agent ?r)(object ?charger)                    ; geometric preconditions
   (setProperty(?r.x, ?charger.x))
   (setProperty(?r.y, ?charger.y))
   (setProperty(?r.heading, ?charger.faces)))
  ( (not (charging ?r)) ))                        ; symbolic effects: (not ...) deletes a fact

;; A gauge is read from near by and from the front: what the robot looks along has to run against the
;; direction in which the dial faces, within 30 degrees.  `faces` is a field of the object in world.yaml.
(Operator (!read_gauge ?r ?gauge)
  ( (gauge ?gauge)(accessible ?gauge)(not (charging ?r)) )
  ((agent ?r)(object ?gauge)
   (distance(?r, ?gauge) >= 0.6)
   (distance(?r, ?gauge) <= 1.5)
   (angle_between(bearing(?r, ?gauge), ?gauge.faces + pi) <= deg(30))
   (field_of_view(?r, ?gauge, deg(20)))
   (visible(?r, ?gauge)))
  ( (inspected ?gauge) ))

;; An extinguisher is red and large: it is enough to have it in the picture, through a door as well.
(Operator (!check_extinguisher ?r ?extinguisher)
  ( (extinguisher ?extinguisher)(accessible ?extinguisher)(not (charging ?r)) )
  ((agent ?r)(object ?extinguisher)
   (distance(?r, ?extinguisher) >= 0.8)
   (distance(?r, ?extinguisher) <= 4)
   (field_of_view(?r, ?extinguisher, deg(60)))
   (visible(?r, ?extinguisher)))
  ( (inspected ?extinguisher) ))

;; The panel of an alarm reads the robot's badge, which is in front.
(Operator (!disarm ?r ?panel ?room)
  ( (controls ?panel ?room)(armed ?room) )
  ((agent ?r)(object ?panel)
   (distance(?r, ?panel) <= 0.7)
   (facing(?r, ?panel))
   (visible(?r, ?panel)))
  ( (not (armed ?room)) ))

(Operator (!arm ?r ?panel ?room)
  ( (controls ?panel ?room)(not (armed ?room)) )
  ((agent ?r)(object ?panel)
   (distance(?r, ?panel) <= 0.7)
   (facing(?r, ?panel))
   (visible(?r, ?panel)))
  ( (armed ?room) ))

;; Back into the charging bay, tail first: the robot looks out of the bay.
(Operator (!charge ?r ?charger ?bay)
  ( (charger ?charger)(bay_of ?charger ?bay) )
  ((agent ?r)(object ?charger)(region ?bay)
   (inside(?r, ?bay))
   (?r.heading = ?charger.faces))
  ( (charging ?r) ))

;; A thing can be inspected when no alarm would go off.
(:- (accessible ?thing) ((in ?thing ?room)(not (armed ?room))))

;; Everything in ?things, in whatever order is best: (:unordered ...) leaves it open, and the motion
;; planner's advice says what is near.
(:method (inspect-all ?_robot nil) () ())
(:method (inspect-all ?r (?thing . ?others))
  ()
  (:unordered (inspect ?r ?thing) (inspect-all ?r ?others)))

;; A method may have several branches: the first whose condition holds is taken.
(:method (inspect ?r ?thing)
  already-seen
  ((inspected ?thing))
  ()
  a-gauge
  ((gauge ?thing))
  ((!read_gauge ?r ?thing))
  an-extinguisher
  ((extinguisher ?thing))
  ((!check_extinguisher ?r ?thing)))

;; Tasks in a plain list are done in that order.
(:method (inspect-behind-alarm ?r ?room ?things)
  ((controls ?panel ?room))
  ((!disarm ?r ?panel ?room)
   (inspect-all ?r ?things)
   (!arm ?r ?panel ?room)))

))
