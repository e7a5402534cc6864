//! Open families against sums of named ones, and against shapes, at their own place.

use faer::Mat;

use crate::bench::{Bench, Model, State};
use crate::families::{Class, Driver, Family, Law, Where};
use crate::function::Function;
use crate::greedy::{Greedy, tune};
use crate::likelihood::Active;
use crate::record::{Reason, Recorder};
use crate::shape::{Shape, finer, half_step, library};
use crate::small::{Small, whitened};

/// Named laws that one open family may be a sum of.
const NAMED: usize = 4;

impl Bench<'_> {
    /// Each open family against at most four named ones in its stead.
    pub(crate) fn unpacked(&self, model: &Model, record: &mut Recorder) -> Model {
        let mut best = model.clone();
        let named = |family: usize| self.dictionary.families[family].is_named();
        for &(family, _) in &model.active {
            if !best.has(family) || !self.dictionary.families[family].is_open() {
                continue;
            }
            let others: Active = best.active.iter().copied().filter(|&(other, _)| other != family).collect();
            let view = self.view(model.state);
            let greedy = Greedy { view: &view, allowed: &named, most: others.len() + NAMED };
            let mut steps = record.clone();
            let sum = self.model(greedy.from(&others, &mut steps), model.state);
            if sum.odds > best.odds {
                *record = steps;
                record.note(family, false, Reason::Unpacked, best.odds - sum.odds);
                best = sum;
            }
        }
        best
    }

    /// What is open, or several harmonics, at one place over one joint, against one or two shapes there.
    pub(crate) fn shaped(&mut self, model: &Model, record: &mut Recorder) -> Model {
        let mut best = model.clone();
        let mut seen = Vec::new();
        for &(first, _) in &model.active {
            let family = &self.dictionary.families[first];
            let (Where::Place(place), Driver::Joint(joint)) = family.site() else { continue };
            if family.is_noise() || seen.contains(&(place, joint)) {
                continue;
            }
            let site = family.site();
            let here: Vec<usize> = best
                .active
                .iter()
                .map(|&(own, _)| own)
                .filter(|&own| self.dictionary.families[own].site() == site && !self.is_noise(own))
                .collect();
            let open = here.iter().any(|&own| matches!(self.dictionary.families[own].law, Law::Smooth(_)));
            if here.is_empty() || !(open || here.len() > 1) {
                continue;
            }
            seen.push((place, joint));
            best = self.shaped_at(&best, place, joint, &here, record);
        }
        best
    }

    fn shaped_at(
        &mut self,
        model: &Model,
        place: usize,
        joint: usize,
        here: &[usize],
        record: &mut Recorder,
    ) -> Model {
        let mut best = model.clone();
        let mut current: Active =
            model.active.iter().copied().filter(|(family, _)| !here.contains(family)).collect();
        let shapes = library(&self.problem.rows.joints[joint].values);
        let count = shapes.len();
        let sites = (self.places.distinct.len() * self.problem.rows.joints.len()) as f64;
        let price = (count as f64).ln() + sites.ln() + self.policy.price_shape;
        for round in 0..2 {
            let Some((at, score)) = self.best_shape(&current, model, place, joint, &shapes) else { break };
            if score <= price {
                break;
            }
            let mut winner = shapes[at];
            let close = finer(&winner, &self.problem.rows.joints[joint].values);
            if let Some((finest, finer_score)) = self.best_shape(&current, model, place, joint, &close)
                && finer_score > score
            {
                winner = close[finest];
            }
            let family = self.add_shape(place, joint, winner, price);
            let view = self.view(model.state);
            let gain = view.one(&current, family);
            if gain.nats <= price {
                break;
            }
            current.push((family, gain.variance));
            let tuned = tune(&view, &current, 2, &mut Recorder::new());
            let shaped = self.model(tuned, model.state);
            if shaped.odds <= best.odds {
                if round == 0 {
                    continue;
                }
                break;
            }
            for &gone in here.iter().filter(|&&gone| best.has(gone)) {
                record.note(gone, false, Reason::Shaped(family), best.odds - shaped.odds);
            }
            record.note(family, true, Reason::Best, gain.nats - price);
            best = shaped;
            current.clone_from(&best.active);
        }
        // What a shape leaves may still be smooth.
        if best.active != model.active {
            for &open in here.iter().filter(|&&own| self.dictionary.families[own].is_open()) {
                let Some(&(_, variance)) = model.active.iter().find(|(own, _)| *own == open) else {
                    continue;
                };
                let mut both = best.active.clone();
                both.push((open, variance));
                let tuned = tune(&self.view(model.state), &both, 2, &mut Recorder::new());
                let both = self.model(tuned, model.state);
                if both.odds > best.odds + self.policy.swap_scan {
                    best = both;
                }
            }
        }
        best
    }

    /// The shape that gains most beside an active set, by itself, and its gain.
    fn best_shape(
        &self,
        active: &Active,
        model: &Model,
        place: usize,
        joint: usize,
        shapes: &[Shape],
    ) -> Option<(usize, f64)> {
        let State { noise, memory, point } = model.state;
        let noise = &self.noises[noise];
        let small = Small::of(self, active, point);
        let (moved, components) = (&self.points[point].places[place], self.problem.components);
        let mut columns = Mat::zeros(moved.len(), shapes.len());
        for (at, shape) in shapes.iter().enumerate() {
            for (row, &angle) in self.problem.rows.joints[joint].values.iter().enumerate() {
                let value = shape.at(angle);
                for own in row * components..(row + 1) * components {
                    columns[(own, at)] = moved[own] * value;
                }
            }
        }
        let white = whitened(&columns, components, &noise.weights, memory);
        let products = whitened(&small.columns, components, &noise.weights, memory).transpose() * &white;
        let energies: Vec<f64> =
            (0..shapes.len()).map(|at| white.col(at).iter().map(|value| value * value).sum()).collect();
        let gains = small.view(noise, memory).singles(small.active(), &products, &energies);
        let mut best: Option<(usize, f64)> = None;
        for (at, gain) in gains.iter().enumerate() {
            if gain.nats.is_finite() && best.is_none_or(|(_, most)| gain.nats > most) {
                best = Some((at, gain.nats));
            }
        }
        best
    }

    /// Adds a shape with what its position and width change, and a constant that leaves the declared errors in peace.
    fn add_shape(&mut self, place: usize, joint: usize, shape: Shape, price: f64) -> usize {
        let values = &self.problem.rows.joints[joint].values;
        let mut functions = vec![Function::Shape(joint, shape), Function::One];
        if !shape.jumps() {
            functions.push(Function::ShapeMoved(joint, shape, half_step(&shape, values)));
            if shape.has_width() {
                functions.push(Function::ShapeWidened(joint, shape));
            }
        }
        let columns: Vec<usize> =
            functions.into_iter().map(|function| self.dictionary.column(vec![(place, function)])).collect();
        let family = self.dictionary.push(Family {
            class: Class::Shape,
            place: Where::Place(place),
            driver: Driver::Joint(joint),
            law: Law::Shape(shape),
            relative: vec![1.0; columns.len()],
            columns,
            extra: 0.0,
            price,
        });
        self.take_in();
        // All columns count in the unit of the shape itself: its changes are small where they are small.
        let size = self.size(self.dictionary.families[family].columns[0]);
        self.scaled[family].deviations.fill(if size > 0.0 { size.recip() } else { 1.0 });
        family
    }
}
