__attribute__((visibility("default"))) int gone() { return 1; }
