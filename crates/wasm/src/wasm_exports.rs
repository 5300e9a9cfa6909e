//! The door of the compiled module: text in, text out, through its own memory.
//!
//! The page asks for [`room`], writes a question there, calls [`answer`] and reads as many bytes from
//! [`text`]. The only file with `unsafe` in it: an exported name must be unique in what is linked, which
//! the compiler cannot see. No pointer is ever followed on this side.
#![allow(unsafe_code, reason = "exported names")]

use std::cell::RefCell;

thread_local! {
    static TEXT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Room for a question of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    TEXT.with_borrow_mut(|text| {
        text.clear();
        text.resize(bytes, 0);
        text.as_mut_ptr()
    })
}

/// Puts the answer in the place of the question and returns its length in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    TEXT.with_borrow_mut(|text| {
        *text = crate::question::answer(&String::from_utf8_lossy(text)).into_bytes();
        text.len()
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn text() -> *const u8 {
    TEXT.with_borrow(|text| text.as_ptr())
}
