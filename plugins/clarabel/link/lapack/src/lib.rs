#[link(name = "lapack")]
extern "C" {}
