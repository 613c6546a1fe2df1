"""What a candidate would cost, without planning its motion."""
