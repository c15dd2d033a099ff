"""The drawing beside the solver: both compared, results that can be trusted, and reports of them."""
