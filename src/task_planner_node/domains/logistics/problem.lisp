;; Two cities, a truck in each, one aeroplane, three packages.

(defproblem three-packages logistics
 ((place post-1 lyon) (place air-1 lyon) (airport air-1) (truck truck-1 lyon)
  (place post-2 nice) (place air-2 nice) (airport air-2) (truck truck-2 nice)
  (plane plane-1)
  (at truck-1 air-1) (at truck-2 post-2) (at plane-1 air-2)
  (at letter post-1) (at parcel post-1) (at crate air-2))
 ((:unordered (deliver letter post-2) (deliver parcel air-1) (deliver crate post-1))))
