//! Which rows are taken together, as stretches of rows that follow each other: all of them, chunks, or a sample.

use std::ops::Range;

use rand::RngExt;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rayon::prelude::*;

use observe::Observations;
use observe::unknowns::Unknowns;

/// Rows of a chunk.
const CHUNK: usize = 1024;

/// Consecutive rows of a sample that stay together, so that what follows each other can still be compared.
const STRETCH: usize = 64;

/// All rows, one stretch a series.
pub(crate) fn all_rows(observations: &Observations) -> Vec<Range<usize>> {
    let rows = observations.poses.series.iter().map(|series| series.rows.clone());
    rows.filter(|rows| !rows.is_empty()).collect()
}

/// All rows, cut into chunks.
pub(crate) struct Chunks<'a> {
    observations: &'a Observations,
    /// Of one chunk after another, each in order.
    rows: Vec<u32>,
    /// Where each chunk ends.
    ends: Vec<usize>,
}

impl<'a> Chunks<'a> {
    /// Of rows as they follow each other, each chunk within one series; but rows of one object lie in one chunk.
    pub fn in_order(observations: &'a Observations) -> Self {
        if observations.unknowns.is_some() {
            return Self::by(observations, |_| 0);
        }
        Self::of(observations, pieces(observations, CHUNK).into_iter().map(Iterator::collect))
    }

    /// Of rows that `key` makes alike as far as may be, so that a chunk has many rows of each of few kinds; rows of one object lie
    /// in one chunk, where the key of its first row puts them.
    pub fn by(observations: &'a Observations, key: impl Fn(usize) -> usize + Sync) -> Self {
        let Some(unknowns) = &observations.unknowns else {
            let mut rows: Vec<usize> = (0..observations.rows()).collect();
            rows.par_sort_by_key(|&row| key(row));
            return Self::of(observations, rows.chunks(CHUNK).map(<[usize]>::to_vec));
        };
        let mut first = vec![usize::MAX; unknowns.objects.len()];
        for (row, object) in unknowns.object.iter().enumerate() {
            if let Some(first) = object.and_then(|object| first.get_mut(object as usize)) {
                *first = row.min(*first);
            }
        }
        let mut objects: Vec<usize> = (0..first.len()).filter(|&object| first[object] < usize::MAX).collect();
        objects.sort_by_key(|&object| key(first[object]));
        let mut bare: Vec<usize> =
            (0..observations.rows()).filter(|&row| unknowns.object[row].is_none()).collect();
        bare.sort_by_key(|&row| key(row));
        let bare = bare.chunks(CHUNK).map(<[usize]>::to_vec);
        Self::of(observations, by_object(unknowns, &objects).into_iter().chain(bare))
    }

    fn of(observations: &'a Observations, each: impl Iterator<Item = Vec<usize>>) -> Self {
        let (mut rows, mut ends) = (Vec::with_capacity(observations.rows()), Vec::new());
        for mut chunk in each {
            chunk.sort_unstable();
            // Rows are counted with 32 bits wherever they are held.
            rows.extend(chunk.into_iter().map(|row| row as u32));
            ends.push(rows.len());
        }
        Self { observations, rows, ends }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.ends.len()
    }

    /// The rows of one.
    pub fn stretches(&self, chunk: usize) -> Vec<Range<usize>> {
        let start = chunk.checked_sub(1).map_or(0, |before| self.ends[before]);
        stretches(self.observations, &self.rows[start..self.ends[chunk]])
    }
}

/// Rows of some objects, whole objects together until they fill a chunk.
fn by_object(unknowns: &Unknowns, objects: &[usize]) -> Vec<Vec<usize>> {
    let mut place = vec![usize::MAX; unknowns.objects.len()];
    objects.iter().enumerate().for_each(|(at, &object)| place[object] = at);
    let mut rows: Vec<Vec<usize>> = vec![Vec::new(); objects.len()];
    for (row, object) in unknowns.object.iter().enumerate() {
        if let Some(own) = object.and_then(|object| rows.get_mut(place[object as usize])) {
            own.push(row);
        }
    }
    let mut full: Vec<Vec<usize>> = Vec::new();
    for own in rows {
        match full.last_mut() {
            Some(last) if last.len() < CHUNK => last.extend(own),
            _ => full.push(own),
        }
    }
    full
}

/// Rows in order as stretches, each within one series.
pub(crate) fn stretches(observations: &Observations, rows: &[u32]) -> Vec<Range<usize>> {
    let series = &observations.poses.series;
    let ends = |row: u32| series.iter().any(|series| series.rows.end == row as usize);
    let runs = rows.chunk_by(|&a, &b| a + 1 == b && !ends(b));
    runs.map(|own| own[0] as usize..own[0] as usize + own.len()).collect()
}

/// About so many rows from all over the data: of each of equally long parts, one stretch from a random place in it; or whole
/// objects.
pub(crate) fn sample(observations: &Observations, rows: usize, seed: u64) -> Vec<Range<usize>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    if let Some(unknowns) = &observations.unknowns {
        let mut objects: Vec<usize> = (0..unknowns.objects.len()).collect();
        objects.shuffle(&mut random);
        let share = rows as f64 / observations.rows().max(1) as f64;
        objects.truncate(((objects.len() as f64 * share).ceil() as usize).max(1));
        let mut all: Vec<usize> = by_object(unknowns, &objects).into_iter().flatten().collect();
        let bare = unknowns.object.iter().enumerate().filter(|(_, object)| object.is_none());
        all.extend(bare.map(|(row, _)| row).filter(|_| random.random_bool(share.min(1.0))));
        let mut all: Vec<u32> = all.into_iter().map(|row| row as u32).collect();
        all.sort_unstable();
        return stretches(observations, &all);
    }
    let part = observations.rows().div_ceil((rows / STRETCH).max(1)).max(STRETCH);
    pieces(observations, part)
        .into_iter()
        .map(|part| {
            let length = part.len().min(STRETCH);
            let start = part.start + random.random_range(0..=part.len() - length);
            start..start + length
        })
        .collect()
}

/// Each series cut into pieces of so many rows.
fn pieces(observations: &Observations, length: usize) -> Vec<Range<usize>> {
    let series = observations.poses.series.iter().map(|series| series.rows.clone());
    series
        .flat_map(|rows| {
            let end = rows.end;
            rows.step_by(length).map(move |start| start..(start + length).min(end))
        })
        .collect()
}
