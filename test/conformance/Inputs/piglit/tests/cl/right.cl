PIGLIT: {"result": "pass" }
