;; The night tour: five gates, of which the vault is locked.

(defproblem night-tour guards

((covers car walker)(post post)(parking parking)
 (gate gate_north)(gate gate_east)(gate gate_south)(gate gate_west)(gate vault)
 (hangs vault_key key_box)(locked_with vault vault_key))

((patrol car walker (gate_north gate_east gate_south gate_west vault))
 (!return_key walker key_box vault_key)
 (!fall_in car walker parking)
 (!stand_beside walker car post)))
