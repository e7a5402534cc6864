//! trueaxis for a page in a browser: bytes in, bytes out.
//!
//! A page gives a [`Message`] that says what to do and with which texts and tables; the answer is another. The same functions run on every
//! machine, where tests call them. What a browser calls stands in `exports`.

mod begin;
mod calibrate;
mod correct;
#[cfg(target_arch = "wasm32")]
mod exports;
mod formulas;
mod message;
mod refused;

use std::cell::RefCell;

use serde_json::json;

pub use message::{Broken, Message};
pub use refused::Refused;

/// Hears of what is being done, in words.
pub type Tell<'t> = &'t (dyn Fn(&str) + Sync);

/// Whether the answer is a yes: a usable model came out, every claim holds.
type Answered = Result<(bool, Message), Refused>;

/// What works on a message; warnings go to the last argument.
type Work = fn(&Message, Tell<'_>, &dyn Fn(String)) -> Answered;

/// What a message can ask for.
const WORK: &[(&str, Work)] = &[
    ("begin", begin::begin),
    ("look", begin::look),
    ("templates", begin::templates),
    ("calibrate", calibrate::calibrate),
    ("correct", correct::correct),
    ("generate", correct::generate),
    ("derive", formulas::derive),
    ("identify", formulas::identify),
    ("bound", formulas::bound),
    ("code", formulas::code),
    ("check", formulas::check),
];

/// The answer to a message, as bytes both. `status` is `done`, `no` where the answer is a no, or `refused` where `why` says what to
/// mend; `warnings` is a list in JSON of what is doubtful.
#[must_use]
pub fn answer(request: &[u8], tell: Tell<'_>) -> Vec<u8> {
    let warnings = RefCell::new(Vec::new());
    let answered = Message::from_bytes(request).map_err(Refused::from).and_then(|message| {
        let asked = message.text("do")?;
        let work = WORK.iter().find(|(name, _)| *name == asked).map(|(_, work)| work);
        let work = work.ok_or_else(|| Refused(format!("nothing is known of `{asked}`: reload the page")))?;
        work(&message, tell, &|warning| warnings.borrow_mut().push(warning))
    });
    let (status, mut message) = match answered {
        Ok((true, message)) => ("done", message),
        Ok((false, message)) => ("no", message),
        Err(Refused(why)) => ("refused", Message::default().with("why", why)),
    };
    message = message.with("status", status).with("warnings", json!(warnings.into_inner()).to_string());
    message.to_bytes()
}
