//! What a browser calls. The page asks for `room`, writes a message there, calls `answer`, and reads what lies at `answer_at`. The module
//! needs one function of the page: `tell`.
#![allow(unsafe_code, reason = "names that a browser finds, and a function of the page")]

use std::cell::RefCell;
use std::panic;

thread_local! {
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

// SAFETY: the page reads the text and keeps no part of the memory.
#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Tells the page what is being done.
    safe fn tell(text: *const u8, length: usize);
}

fn say(text: &str) {
    tell(text.as_ptr(), text.len());
}

/// Where the page writes a message of so many bytes.
// SAFETY: no other function has this name.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        *request = vec![0; length];
        request.as_mut_ptr()
    })
}

/// Answers the message that lies in the room; says how many bytes the answer has.
// SAFETY: no other function has this name.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    panic::set_hook(Box::new(|panic| say(&format!("the module failed: {panic}"))));
    gemm::set_wasm_simd128(cfg!(target_feature = "simd128"));
    ANSWER.set(Vec::new());
    let answer = crate::answer(&REQUEST.take(), &say);
    let length = answer.len();
    ANSWER.set(answer);
    length
}

/// Where the answer lies, until the next one.
// SAFETY: no other function has this name.
#[unsafe(no_mangle)]
pub extern "C" fn answer_at() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}
