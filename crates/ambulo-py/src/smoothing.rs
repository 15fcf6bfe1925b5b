//! Arguments for the smoothing of a motion.

use ambulo::motion::Smoother;
use ambulo::motion::filter::LowPass;
use pyo3::prelude::*;

/// A cut-off frequency [Hz], or `"off"`.
#[derive(FromPyObject)]
pub(crate) enum Cutoff {
    Hz(f64),
    Word(String),
}

/// The requested smoother; `None` if none is requested. Omitted parts have the defaults of the command.
pub(crate) fn smoother(
    filter: Option<&str>,
    cutoff: Option<Cutoff>,
    order: Option<usize>,
) -> Result<Option<Smoother>, String> {
    let usual = LowPass::MOTION;
    let order_or_usual = order.unwrap_or(usual.order);
    match (filter, cutoff) {
        (None, None) if order.is_none() => Ok(None),
        (Some("spline"), None) if order.is_none() => Ok(Some(Smoother::Spline)),
        (Some("spline"), _) => {
            Err("filter: found 'spline' with a cut-off or an order; expected one of them alone".to_owned())
        }
        (Some(other), _) if other != "butterworth" => {
            Err(format!("filter: found {other:?}; expected 'butterworth' or 'spline'"))
        }
        (_, Some(Cutoff::Word(word))) if word == "off" => Ok(Some(Smoother::Off)),
        (_, Some(Cutoff::Word(word))) => Err(format!("cutoff: found {word:?}; expected a number in Hz, or 'off'")),
        (_, Some(Cutoff::Hz(cutoff_hz))) => {
            Ok(Some(Smoother::Butterworth(LowPass { order: order_or_usual, cutoff_hz })))
        }
        (_, None) => Ok(Some(Smoother::Butterworth(LowPass { order: order_or_usual, ..usual }))),
    }
}
