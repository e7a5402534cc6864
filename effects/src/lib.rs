//! Effects: what a declaration may lack.
//!
//! A candidate is a place in the chain, a degree of freedom there and functions of joints and inputs. Families make candidates, one
//! file a family; the catalogue chooses among them for one chain.

pub mod candidate;
pub mod catalogue;
pub mod families;
