"""The verbs of ``geohtn``, one a module: ``add(verbs)`` declares, ``run(...)`` does it."""
