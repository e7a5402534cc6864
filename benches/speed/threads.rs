//! How much faster two threads are than one: the rows cut in two, each half on a thread of its own, both at once.
//!
//! By the clock that shows how busy the machine is with other programs; by each thread's processor time it shows what
//! the two take from each other (cache, memory, cores that share a unit). On an idle machine the two agree.

use std::hint::black_box;
use std::sync::Barrier;
use std::time::Instant;

use crate::candidates::Buffers;
use crate::lidar::{JointRows, ExactError, ExactJacobian, ExactJacobianBlock, FirstOrderError, Observed, ROWS};
use crate::rounds::processor_ns;

const ROUNDS: usize = 60;

/// A part of all rows.
struct Part<'a> {
    joints: [&'a [f64]; 3],
    out: [&'a mut [f64]; 6],
}

impl Part<'_> {
    fn columns(&self) -> JointRows<'_> {
        JointRows { alpha: self.joints[0], beta: self.joints[1], gamma: self.joints[2] }
    }

    fn split(&mut self) -> (Part<'_>, Part<'_>) {
        let middle = self.joints[0].len() / 2 / ROWS * ROWS;
        let joints = self.joints.map(|column| column.split_at(middle));
        let mut second = Vec::new();
        let first = self.out.each_mut().map(|column| {
            let (head, tail) = column.split_at_mut(middle);
            second.push(tail);
            head
        });
        let mut second = second.into_iter();
        let second = [(); 6].map(|()| second.next().unwrap_or_default());
        (
            Part { joints: joints.map(|(head, _)| head), out: first },
            Part { joints: joints.map(|(_, tail)| tail), out: second },
        )
    }
}

type Form = Box<dyn Fn(Part<'_>) + Sync>;

/// Takes the measurements and prints them.
pub fn run(buffers: &mut Buffers) {
    let first_order = FirstOrderError::prepare(&errors!(v4));
    let exact = ExactError::prepare(&errors!(v4));
    let jacobian = ExactJacobian::prepare(&errors!(v4));
    fn observed(out: [&mut [f64]; 6]) -> Observed<[&mut [f64]; 3]> {
        let [a, b, c, d, e, f] = out;
        Observed { pointing: [a, b, c], position: [d, e, f] }
    }
    let forms: [(&str, Form); 3] = [
        (
            "first-order error",
            Box::new(move |part| {
                let columns = JointRows { alpha: part.joints[0], beta: part.joints[1], gamma: part.joints[2] };
                black_box(first_order.eval_rows(&columns, observed(part.out)).is_ok());
            }),
        ),
        (
            "exact error",
            Box::new(move |part| {
                let columns = JointRows { alpha: part.joints[0], beta: part.joints[1], gamma: part.joints[2] };
                black_box(exact.eval_rows(&columns, observed(part.out)).is_ok());
            }),
        ),
        (
            "exact Jacobian",
            Box::new(move |part| {
                let mut block = Box::new(ExactJacobianBlock::default());
                let columns = part.columns();
                for start in (0..columns.alpha.len()).step_by(ROWS) {
                    let rows = start..start + ROWS;
                    let columns = JointRows {
                        alpha: &columns.alpha[rows.clone()],
                        beta: &columns.beta[rows.clone()],
                        gamma: &columns.gamma[rows],
                    };
                    black_box(jacobian.eval_block(&columns, &mut block).is_ok());
                    black_box(&block);
                }
            }),
        ),
    ];
    println!("\n{:22} {:>28} {:>28}", "two threads", "faster, processor time", "faster, by the clock");
    for (name, form) in &forms {
        let (mut alone, mut both) = ([f64::INFINITY; 2], [f64::INFINITY; 2]);
        for _ in 0..ROUNDS {
            let mut part = Part {
                joints: buffers.joints.each_ref().map(Vec::as_slice),
                out: buffers.out.each_mut().map(Vec::as_mut_slice),
            };
            let (first, second) = part.split();
            keep_least(&mut both, at_once(form, [first, second]));
            keep_least(&mut alone, at_once(form, [part]));
        }
        println!("{name:22} {:28.2} {:28.2}", alone[0] / both[0], alone[1] / both[1]);
    }
}

fn keep_least(least: &mut [f64; 2], times: [f64; 2]) {
    for (least, time) in least.iter_mut().zip(times) {
        *least = least.min(time);
    }
}

/// Does parts at once, a thread each: the processor time of the slowest, and the time by the clock, in ns.
fn at_once<const THREADS: usize>(form: &Form, parts: [Part<'_>; THREADS]) -> [f64; 2] {
    let barrier = Barrier::new(THREADS);
    let times = std::thread::scope(|scope| {
        let threads = parts.map(|part| {
            let barrier = &barrier;
            scope.spawn(move || {
                barrier.wait();
                let (clock, processor) = (Instant::now(), processor_ns());
                form(part);
                [processor_ns() - processor, clock.elapsed().as_secs_f64() * 1e9]
            })
        });
        threads.map(|thread| thread.join().unwrap_or([f64::INFINITY; 2]))
    });
    times.into_iter().fold([0.0; 2], |most, time| [most[0].max(time[0]), most[1].max(time[1])])
}
