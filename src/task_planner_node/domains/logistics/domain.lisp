;; Packages go by truck within a city and by aeroplane between the airports of cities.  Arriving for a load protects
;; the vehicle's place until the package is on or off, so that parallel deliveries share vehicles without conflict.

(defdomain logistics (

(:op (!load ?package ?vehicle ?place)
 :precond ((at ?package ?place) (at ?vehicle ?place))
 :delete ((at ?package ?place))
 :add ((in ?package ?vehicle)))

(:op (!unload ?package ?vehicle ?place)
 :precond ((in ?package ?vehicle) (at ?vehicle ?place))
 :delete ((in ?package ?vehicle))
 :add ((at ?package ?place)))

(:op (!drive ?truck ?from ?to)
 :precond ((truck ?truck ?city) (at ?truck ?from) (place ?from ?city) (place ?to ?city))
 :delete ((at ?truck ?from))
 :add ((at ?truck ?to)))

(:op (!fly ?plane ?from ?to)
 :precond ((plane ?plane) (at ?plane ?from) (airport ?from) (airport ?to))
 :delete ((at ?plane ?from))
 :add ((at ?plane ?to)))

(:op (!!hold ?vehicle ?place)
 :add ((:protection (at ?vehicle ?place)))
 :cost 0)

(:op (!!release ?vehicle ?place)
 :delete ((:protection (at ?vehicle ?place)))
 :cost 0)

(:method (deliver ?package ?goal)
 already-there
 ((at ?package ?goal))
 ()
 within-a-city
 ((at ?package ?start) (place ?start ?city) (place ?goal ?city))
 ((by-truck ?package ?start ?goal ?city))
 between-cities
 ((at ?package ?start) (place ?start ?here) (place ?goal ?there)
  (airport ?departure) (place ?departure ?here) (airport ?arrival) (place ?arrival ?there))
 ((by-truck ?package ?start ?departure ?here)
  (by-plane ?package ?departure ?arrival)
  (by-truck ?package ?arrival ?goal ?there)))

(:method (by-truck ?_package ?place ?place ?_city)
 ()
 ())

(:method (by-truck ?package ?from ?to ?city)
 ((different ?from ?to) (truck ?truck ?city))
 ((bring ?truck ?from)
  (:immediate !load ?package ?truck ?from)
  (:immediate !!release ?truck ?from)
  (bring ?truck ?to)
  (:immediate !unload ?package ?truck ?to)
  (:immediate !!release ?truck ?to)))

(:method (by-plane ?package ?from ?to)
 (:first (or (and (plane ?plane) (at ?plane ?from)) (plane ?plane)))
 ((bring ?plane ?from)
  (:immediate !load ?package ?plane ?from)
  (:immediate !!release ?plane ?from)
  (bring ?plane ?to)
  (:immediate !unload ?package ?plane ?to)
  (:immediate !!release ?plane ?to)))

(:method (bring ?vehicle ?place)
 stay
 ((at ?vehicle ?place))
 ((:immediate !!hold ?vehicle ?place))
 go-by-road
 ((truck ?vehicle ?_city) (at ?vehicle ?from))
 ((:immediate !drive ?vehicle ?from ?place) (:immediate !!hold ?vehicle ?place))
 go-by-air
 ((plane ?vehicle) (at ?vehicle ?from))
 ((:immediate !fly ?vehicle ?from ?place) (:immediate !!hold ?vehicle ?place)))

(:- (different ?x ?y) ((call not (call equal ?x ?y))))

))
