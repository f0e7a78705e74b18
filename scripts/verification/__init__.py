"""What scripts/verify_contact is made of: exact solutions, what a run came out with, the cases, pictures."""
