#[link(name = "blas")]
extern "C" {}
