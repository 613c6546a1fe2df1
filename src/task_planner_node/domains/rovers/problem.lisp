;; Four places in a row; the lander is seen from the second one.

(defproblem row rovers
 ((way p1 p2) (way p2 p1) (way p2 p3) (way p3 p2) (way p3 p4) (way p4 p3)
  (hops p1 p2 1) (hops p2 p1 1) (hops p2 p3 1) (hops p3 p2 1) (hops p3 p4 1) (hops p4 p3 1)
  (hops p1 p3 2) (hops p3 p1 2) (hops p2 p4 2) (hops p4 p2 2) (hops p1 p4 3) (hops p4 p1 3)
  (lander-visible p2)
  (at driller p1) (has-drill driller) (store-empty driller)
  (at looker p4) (camera wide looker) (supports wide colour)
  (soil p1) (soil p3) (visible crater p1) (visible crater p3)
  (wanted (soil-of p1)) (wanted (soil-of p3)) (wanted (image-of crater colour)))
 ((investigate)))
