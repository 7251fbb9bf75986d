"""What the built-in functions of OpenCL C have to give, and what runs them."""
