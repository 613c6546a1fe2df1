;; Eight photos, as in the paper.

(defproblem eight-photos rover

;; initial state
((rover rover0)(available rover0)
(camera cam_0)(has_camera rover0 cam_0)
(location location0)(location location1)
(location location2)(location location3)
(location location4)(location location5)
(location location6)(location location7)
(location location8))

;; tasks
((!init_rover_attitude rover0 location0)
(achieve-goals (list
(has_photo_of rover0 location1)
(has_photo_of rover0 location2)
(has_photo_of rover0 location3)
(has_photo_of rover0 location4)
(has_photo_of rover0 location5)
(has_photo_of rover0 location6)
(has_photo_of rover0 location7)
(has_photo_of rover0 location8)
))))
