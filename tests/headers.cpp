// What carries the precompiled header of the tests; it has no tests of its own.
