"""How a checkout becomes a built workspace. Standard library only: it runs before anything is installed."""
