"""What is drawn beside what is solved: compared, trusted, told."""
