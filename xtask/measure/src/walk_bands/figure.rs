//! The picture of docs/WALK_BANDS.md: nine curves of free walking over the bands of people.

use super::curve::QUANTITIES;
use super::cycle::Cycle;
use crate::normative::Band;
use plotters::coord::Shift;
use plotters::prelude::*;

/// The library rounds coordinates to whole pixels, so pictures are drawn on a canvas this much larger than they are shown.
const FINE: u32 = 4;
/// Width and height of one panel as shown [px].
const PANEL: (u32, u32) = (270, 190);

const INK: RGBColor = RGBColor(40, 40, 40);
const GREY: RGBColor = RGBColor(120, 120, 120);
const BAND: RGBColor = RGBColor(215, 215, 215);
/// Okabe and Ito's palette (unverified), told apart by colour-blind eyes.
const OURS: RGBColor = RGBColor(0, 114, 178);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Angles, moments, forces and forward speed of a cycle; people have no band of the last.
pub(super) fn free(cycle: &Cycle, people: &[Band; 8]) -> Result<String, String> {
    draw(cycle, people).map_err(|e| format!("walk_bands_free.svg: {e}"))
}

fn draw(cycle: &Cycle, people: &[Band; 8]) -> Result<String, Box<dyn std::error::Error>> {
    let (width, height) = (3 * PANEL.0, 3 * PANEL.1);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (FINE * width, FINE * height)).into_drawing_area();
        root.fill(&WHITE)?;
        let panels = root.split_evenly((3, 3));
        for quantity in QUANTITIES {
            let i = quantity.index();
            draw_panel(
                &panels[i],
                &format!("{} [{}]", quantity.name(), quantity.axis()),
                &cycle.curves[i],
                Some(&people[i]),
            )?;
        }
        draw_panel(&panels[8], "speed of the centre of mass [m/s]", &cycle.curves[8], None)?;
        root.present()?;
    }
    let fine = format!("width=\"{}\" height=\"{}\" viewBox", FINE * width, FINE * height);
    Ok(svg.replacen(&fine, &format!("width=\"{width}\" height=\"{height}\" viewBox"), 1))
}

/// Samples with their percent of the cycle.
fn places(curve: &[f64]) -> Vec<(f64, f64)> {
    let count = (curve.len() - 1) as f64;
    curve.iter().enumerate().map(|(i, value)| (100.0 * i as f64 / count, *value)).collect()
}

fn draw_panel(area: &Area<'_>, caption: &str, curve: &[f64], band: Option<&Band>) -> Drawn {
    let edge = |side: f64| -> Vec<f64> {
        let band = band.into_iter().flat_map(|band| band.mean.iter().zip(&band.sd));
        band.map(|(mean, sd)| mean + side * 2.0 * sd).collect()
    };
    let edges = [edge(1.0), edge(-1.0)];
    let values = curve.iter().chain(edges.iter().flatten()).copied();
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (a.min(value), b.max(value)));
    let room = 0.06 * (high - low);
    let mut chart = ChartBuilder::on(area)
        .caption(caption, font(12))
        .margin(FINE * 6)
        .margin_right(FINE * 16)
        .x_label_area_size(FINE * 20)
        .y_label_area_size(FINE * 34)
        .build_cartesian_2d(0.0..100.0, low - room..high + room)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(235, 235, 235).stroke_width(FINE))
        .axis_style(GREY.stroke_width(FINE))
        .label_style(font(10))
        .x_labels(6)
        .y_labels(5)
        .x_label_formatter(&|x| format!("{x:.0} %"))
        .draw()?;
    if let Some(band) = band {
        let [above, below] = edges.map(|edge| places(&edge));
        let outline: Vec<(f64, f64)> = above.into_iter().chain(below.into_iter().rev()).collect();
        chart.draw_series([Polygon::new(outline, BAND.filled())])?;
        chart.draw_series(LineSeries::new(places(&band.mean), BLACK.stroke_width(FINE)))?;
    }
    chart.draw_series(LineSeries::new(places(curve), OURS.stroke_width(2 * FINE)))?;
    Ok(())
}

fn font(size: u32) -> TextStyle<'static> {
    ("sans-serif", FINE * size).into_font().color(&INK)
}
