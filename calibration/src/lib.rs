//! Measured data: observations, fit, noise, diagnosis, effects, amendment, report data.
