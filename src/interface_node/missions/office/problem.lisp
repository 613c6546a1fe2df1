;; The evening round: four gauges and five extinguishers.

(defproblem evening-round office

;; initial state: labels are spelt as in world.yaml
((robot inspector)(charging inspector)
 (charger charger)(bay_of charger charging_bay)

 (gauge gauge_boiler)   (in gauge_boiler boiler_room)
 (gauge gauge_water)    (in gauge_water kitchen)
 (gauge gauge_gas)      (in gauge_gas laboratory)
 (gauge gauge_cooling)  (in gauge_cooling server_room)

 (extinguisher extinguisher_lobby)   (in extinguisher_lobby lobby)
 (extinguisher extinguisher_lab)     (in extinguisher_lab laboratory)
 (extinguisher extinguisher_archive) (in extinguisher_archive archive)
 (extinguisher extinguisher_office)  (in extinguisher_office office)
 (extinguisher extinguisher_server)  (in extinguisher_server server_room)

 (armed server_room)(controls alarm_panel server_room))

;; tasks
((!leave_charger inspector charger)
 (:unordered
  (inspect-all inspector (gauge_boiler gauge_water gauge_gas extinguisher_lobby
                          extinguisher_lab extinguisher_archive extinguisher_office))
  (inspect-behind-alarm inspector server_room (gauge_cooling extinguisher_server)))
 (!charge inspector charger charging_bay)))
