"""The true motion: speed and time under the loads, from rest or at any speed, and how it is drawn."""
