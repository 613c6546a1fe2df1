"""What the tests across nodes share: an independent checker, and the product's own processes."""
