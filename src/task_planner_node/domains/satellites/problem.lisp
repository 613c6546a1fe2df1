;; One satellite with two instruments.

(defproblem two-modes satellites
 ((on-board infrared probe) (supports infrared thermal) (target infrared sun)
  (on-board lens probe) (supports lens visible) (supports lens spectral) (target lens vega)
  (power probe) (pointing probe sun)
  (wanted mars thermal) (wanted mars visible) (wanted vega spectral))
 ((observe)))
