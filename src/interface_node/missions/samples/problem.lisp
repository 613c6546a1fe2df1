;; Four samples and three pictures, with a store of two compartments and two cameras.

(defproblem first-day samples

((rover rover)(lander lander)
 (compartment_of compartment_a rover)(compartment_of compartment_b rover)
 (free compartment_a)(free compartment_b)
 (memory_free rover)

 (on_board mast_camera rover)(supports mast_camera colour)
 (calibration_target mast_camera target_lander)(calibration_target mast_camera target_east)
 (on_board infrared_camera rover)(supports infrared_camera infrared)
 (calibration_target infrared_camera target_lander)

 (sample basalt)(sample clay)(sample sulfate)(sample dust)
 (objective cliff)(objective crater)(objective dune))

((achieve-goals (list
  (delivered basalt)
  (delivered clay)
  (delivered sulfate)
  (delivered dust)
  (received cliff colour)
  (received crater colour)
  (received dune infrared)))))
