;; Satellites photograph directions of the sky.  One instrument of a satellite has power at a time, and it has to be
;; calibrated on its own target after it was switched on.

(defdomain satellites (

(:op (!turn ?satellite ?from ?to)
 :precond ((pointing ?satellite ?from))
 :delete ((pointing ?satellite ?from))
 :add ((pointing ?satellite ?to)))

(:op (!switch-on ?instrument ?satellite)
 :precond ((on-board ?instrument ?satellite) (power ?satellite))
 :delete ((power ?satellite) (calibrated ?instrument))
 :add ((active ?instrument)))

(:op (!switch-off ?instrument ?satellite)
 :precond ((on-board ?instrument ?satellite) (active ?instrument))
 :delete ((active ?instrument))
 :add ((power ?satellite)))

(:op (!calibrate ?instrument ?satellite)
 :precond ((active ?instrument) (on-board ?instrument ?satellite)
           (target ?instrument ?direction) (pointing ?satellite ?direction))
 :add ((calibrated ?instrument)))

(:op (!take-image ?satellite ?direction ?instrument ?mode)
 :precond ((pointing ?satellite ?direction) (on-board ?instrument ?satellite)
           (calibrated ?instrument) (active ?instrument) (supports ?instrument ?mode))
 :add ((image ?direction ?mode)))

(:method (observe)
 next-image
 (:first (wanted ?direction ?mode) (not (image ?direction ?mode)))
 ((photograph ?direction ?mode) (observe))
 done
 ()
 ())

;; An instrument that is ready already saves the most work.
(:method (photograph ?direction ?mode)
 ready
 (:first (supports ?instrument ?mode) (active ?instrument) (calibrated ?instrument)
  (on-board ?instrument ?satellite))
 ((point ?satellite ?direction) (!take-image ?satellite ?direction ?instrument ?mode))
 to-be-prepared
 ((supports ?instrument ?mode) (on-board ?instrument ?satellite))
 ((prepare ?instrument ?satellite)
  (point ?satellite ?direction)
  (!take-image ?satellite ?direction ?instrument ?mode)))

(:method (prepare ?instrument ?satellite)
 ((target ?instrument ?direction))
 ((activate ?instrument ?satellite) (point ?satellite ?direction) (!calibrate ?instrument ?satellite)))

(:method (activate ?instrument ?satellite)
 ((active ?instrument))
 ()
 ((power ?satellite))
 ((!switch-on ?instrument ?satellite))
 ((on-board ?other ?satellite) (active ?other))
 ((!switch-off ?other ?satellite) (!switch-on ?instrument ?satellite)))

(:method (point ?satellite ?direction)
 ((pointing ?satellite ?direction))
 ()
 ((pointing ?satellite ?from))
 ((!turn ?satellite ?from ?direction)))

))
