//! What holds the frame of objects and stations, and what is held out together for it.

use super::{Freedom, Shape, Unknowns};
use crate::joined::Joined;

/// So many exact points at most are held out together where they alone hold the frame: without some of them the others would not.
const FEW: usize = 5;

impl Unknowns {
    /// The exact points that alone hold the frame, where they are few; of more, those that stay hold it when some are held out.
    pub fn points_of_frame(&self) -> Vec<usize> {
        let are_free = self.station.iter().all(|&own| self.stations[own as usize].freedom == Freedom::Free);
        let stated = || self.objects.iter().enumerate().filter(|(_, own)| own.freedom != Freedom::Free);
        let are_points = stated().all(|(_, own)| own.shape == Shape::Point && own.freedom == Freedom::Given);
        if !are_free || !are_points || stated().count() > FEW {
            return Vec::new();
        }
        stated().map(|(object, _)| object).collect()
    }

    /// What is held out together, row by row: rows of one object, rows of one group, and the points that hold the frame.
    #[must_use]
    pub fn together(&self, groups: &[u32]) -> Vec<u32> {
        let objects = self.objects.len();
        let most = groups.iter().copied().max().map_or(0, |most| most as usize + 1);
        let mut joined = Joined::alone(objects + most);
        for pair in self.points_of_frame().windows(2) {
            joined.join(pair[0], pair[1]);
        }
        for (object, &group) in self.object.iter().zip(groups) {
            if let Some(object) = *object {
                joined.join(object as usize, objects + group as usize);
            }
        }
        groups.iter().map(|&group| joined.first(objects + group as usize) as u32).collect()
    }
}
