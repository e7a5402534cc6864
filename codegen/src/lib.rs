//! Straight-line programs from derived forms, their interpreter and one writer per language.
