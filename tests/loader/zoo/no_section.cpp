// A shared object of another program.
extern "C" __attribute__((visibility("default"))) int answer() { return 42; }
