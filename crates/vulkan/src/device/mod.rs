//! A Vulkan device that draws lists of primitives, each in a cell of its own, and reads them back.
//!
//! [`find`] loads the loader and lists devices (`icd` says why there are none), [`open`] makes one
//! ready, [`memory`] owns what is allocated, [`page`] knows the kinds of pictures, `pipeline` makes render passes and pipelines,
//! [`draw`] records, submits and waits. No window and no surface: pictures are images of 1024 x 1024 px that hold 256 cells.
//!
//! # What the `unsafe` blocks rely on
//! Every handle is owned by a value that holds what it was made from ([`open::Opened`] holds the
//! instance, buffers and images hold the device) and is destroyed when that value is dropped, so no
//! handle outlives its parent. [`draw::Painter`] is the only one that submits, takes `&mut self`, and
//! waits for its fence before it returns, so nothing is in use by the device between calls.

pub mod draw;
pub mod find;
mod icd;
pub mod kind;
pub mod memory;
pub mod open;
mod page;
mod pipeline;

use std::fmt;

use ash::vk;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// The loader, `libvulkan`, cannot be loaded: what the system says.
    NoLoader(String),
    /// The loader finds no driver that it can use; what is wrong with the ICD files that are named.
    NoDriver(Vec<String>),
    /// No device of this name: the word, the devices that there are, and what is wrong with the ICD
    /// files that are named.
    Unknown(String, Vec<String>, Vec<String>),
    Unsupported(String),
    OutOfMemory(&'static str),
    /// The device was lost: the driver or the hardware gave up.
    Lost(&'static str),
    /// No answer within so many seconds.
    Hangs(u64),
    /// Something else failed: what, and Vulkan's name for it.
    Failed(&'static str, String),
}

impl Error {
    fn of(what: &'static str, result: vk::Result) -> Self {
        match result {
            vk::Result::ERROR_OUT_OF_HOST_MEMORY | vk::Result::ERROR_OUT_OF_DEVICE_MEMORY => {
                Self::OutOfMemory(what)
            }
            vk::Result::ERROR_DEVICE_LOST => Self::Lost(what),
            vk::Result::ERROR_INCOMPATIBLE_DRIVER => Self::NoDriver(icd::faults()),
            other => Self::Failed(what, format!("{other:?}")),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoLoader(why) => write!(
                f,
                "no Vulkan loader: {why}\n  install it (Debian: libvulkan1), and a driver \
                 (mesa-vulkan-drivers)"
            ),
            Self::NoDriver(faults) => {
                f.write_str("no Vulkan driver: the loader finds none that it can use")?;
                faults.iter().try_for_each(|fault| write!(f, "\n  {fault}"))?;
                f.write_str(
                    "\n  install one (Debian: mesa-vulkan-drivers), or name its ICD file: ",
                )?;
                f.write_str("VK_DRIVER_FILES=FILE.json")
            }
            Self::Unknown(word, there, faults) => {
                write!(f, "no Vulkan device is called '{word}'; there are:")?;
                there.iter().try_for_each(|name| write!(f, "\n    {name}"))?;
                faults.iter().try_for_each(|fault| write!(f, "\n  {fault}"))?;
                f.write_str("\n  VK_DRIVER_FILES=FILE.json names a driver that is not installed")
            }
            Self::Unsupported(what) => write!(f, "the Vulkan device cannot be judged: {what}"),
            Self::OutOfMemory(what) => write!(f, "out of memory while {what}"),
            Self::Lost(what) => write!(f, "device lost while {what}"),
            Self::Hangs(s) => write!(f, "the device did not answer within {s} s"),
            Self::Failed(what, name) => write!(f, "{name} while {what}"),
        }
    }
}

impl std::error::Error for Error {}

trait While<T> {
    fn during(self, what: &'static str) -> Result<T, Error>;
}

impl<T> While<T> for Result<T, vk::Result> {
    fn during(self, what: &'static str) -> Result<T, Error> {
        self.map_err(|result| Error::of(what, result))
    }
}
