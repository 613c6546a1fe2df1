"""What HDDL and SHOP3's domains have from PDDL: types, formulas, effects, actions."""
