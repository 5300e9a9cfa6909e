//! Vulkan devices as engines: see `docs/gpu.md`, and `docs/ARCHITECTURE.md` for the workspace.
//!
//! [`device`] draws lists of primitives on a device and reads them back; it is the only module here
//! that calls what the compiler cannot check. [`gpu`] judges what came back.
#![deny(unsafe_code, unsafe_op_in_unsafe_fn, clippy::undocumented_unsafe_blocks)]

#[allow(unsafe_code, reason = "Vulkan is a C interface; each block says why it may be called")]
pub mod device;
pub mod gpu;
