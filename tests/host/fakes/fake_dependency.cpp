// The library that a fake needs, and that the loader does not find.
extern "C" __attribute__((visibility("default"))) int fake_dependency() { return 0; }
