//! Work for all processors, in one place: whoever has some for them calls this, so that what shares it out is compiled once and not for every
//! caller.
//!
//! For parts that take microseconds at least. What does less for each row goes over rows in blocks, or through `rayon` by itself.

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

/// What `of` makes of 0, 1, 2, …, in this order.
pub fn each<T: Send>(count: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let made: Vec<Mutex<Option<T>>> = (0..count).map(|_| Mutex::new(None)).collect();
    share_out(count, &|number| {
        let own = of(number);
        *made[number].lock().unwrap_or_else(PoisonError::into_inner) = Some(own);
    });
    let taken = |own: Mutex<Option<T>>| match own.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(own) => own,
        None => unreachable!("every part was made, or its panic has gone on"),
    };
    made.into_iter().map(taken).collect()
}

/// What `of` makes of each of some things, in their order.
pub fn each_of<I: Send, T: Send>(things: impl IntoIterator<Item = I>, of: impl Fn(I) -> T + Sync) -> Vec<T> {
    let things: Vec<Mutex<Option<I>>> = things.into_iter().map(|thing| Mutex::new(Some(thing))).collect();
    each(things.len(), |number| {
        let own = things[number].lock().unwrap_or_else(PoisonError::into_inner).take();
        match own {
            Some(own) => of(own),
            None => unreachable!("every thing is taken once"),
        }
    })
}

/// Parts of any length, on all processors.
fn share_out(count: usize, part: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(part);
}

#[cfg(test)]
mod tests {
    use super::{each, each_of};

    #[test]
    fn parts_come_in_their_order_whatever_they_take() {
        let slow = |number: usize| (0..(1000 - number) * 10).fold(number, |sum, own| sum ^ own ^ own);
        assert_eq!(each(1000, slow), (0..1000).collect::<Vec<_>>());
        let mut words = vec![String::from("a"), String::from("b")];
        let lengths = each_of(words.iter_mut().enumerate(), |(number, word)| {
            word.push_str(&"x".repeat(number));
            word.len()
        });
        assert_eq!((lengths, words), (vec![1, 2], vec!["a".to_owned(), "bx".to_owned()]));
        assert!(each(0, |_| 1).is_empty());
    }

    #[test]
    #[should_panic(expected = "the third")]
    fn a_panic_goes_on() {
        each(8, |number| assert_ne!(number, 3, "the third"));
    }
}
