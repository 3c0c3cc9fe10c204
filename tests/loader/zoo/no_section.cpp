// A shared object that means something to somebody else.
extern "C" __attribute__((visibility("default"))) int answer() { return 42; }
