//! Colors of the bands: three sets of anchors, and what lies between them.
//!
//! Between anchors colors are mixed in OKLab (B. Ottosson, "A perceptual color space for image processing", 2020), where
//! equal steps look equal.

/// A color as sRGB bytes.
pub type Rgb = [u8; 3];

/// Its six hexadecimal digits.
pub fn hex([r, g, b]: Rgb) -> String {
    format!("{r:02x}{g:02x}{b:02x}")
}

/// Low cap, nine bands from low to high, high cap.
type Anchors = [u32; 11];

/// Spectral, green in the middle: the one inspectors know.
const INSPECT: Anchors = [
    0x14104f, 0x1b2fd0, 0x2a7df0, 0x37bdf2, 0x7fe3dc, 0x2fa84a, 0xdfee7a, 0xf7cf1e, 0xee8420, 0xd3201f,
    0x650812,
];
/// Blue to brown, apart for every kind of color vision.
const SAFE: Anchors = [
    0x0a1c47, 0x17509e, 0x3f86c9, 0x7fb6de, 0xbcd9ec, 0xeef0ea, 0xf7dcae, 0xf0b765, 0xde8a2c, 0xa9500f,
    0x541f04,
];
/// Grays for print; the hatching's direction tells the sides apart.
const MONO: Anchors = [
    0x1c1c1c, 0x4a4a4a, 0x737373, 0x9a9a9a, 0xc2c2c2, 0xf2f2f2, 0xc2c2c2, 0x9a9a9a, 0x737373, 0x4a4a4a,
    0x1c1c1c,
];

/// Names of the palettes, the default first.
pub const NAMES: [&str; 3] = ["inspect", "safe", "mono"];

/// Colors of `bands` bands from low to high, between the two caps: `bands + 2` in all.
/// An unknown name means `inspect`. With nine bands they are the anchors themselves.
pub fn colors(name: &str, bands: usize) -> Vec<Rgb> {
    let anchors = match name {
        "safe" => SAFE,
        "mono" => MONO,
        _ => INSPECT,
    }
    .map(bytes);
    let inner = &anchors[1..10];
    let mut all = vec![anchors[0]];
    all.extend((0..bands).map(|i| {
        let t = if bands == 1 { 4.0 } else { 8.0 * i as f64 / (bands - 1) as f64 };
        let low = (t.floor() as usize).min(7);
        mix(inner[low], inner[low + 1], t - low as f64)
    }));
    all.push(anchors[10]);
    all
}

/// Colors that tell kinds apart, each clear of the gray of a part in light and shade.
const CATEGORIES: [u32; 10] =
    [0xd6006c, 0xf07800, 0x0b62e0, 0x00913f, 0x7d3cf0, 0xc81e1e, 0x008fa3, 0x9a6700, 0x5c6b00, 0xff5fa8];

/// The color of the `n`-th kind. Beyond ten the same come again, lighter or darker.
pub fn category(n: usize) -> Rgb {
    let base = bytes(CATEGORIES[n % CATEGORIES.len()]);
    let round = n / CATEGORIES.len();
    let toward = if round % 2 == 1 { [255; 3] } else { [0; 3] };
    // Never so far that it would be white or black.
    mix(base, toward, (0.22 * round.div_ceil(2) as f64).min(0.66))
}

fn bytes(hex: u32) -> Rgb {
    [(hex >> 16) as u8, (hex >> 8) as u8, hex as u8]
}

/// The color a share `t` (0 to 1) of the way from `a` to `b`; exactly `a` at 0 and `b` at 1.
pub fn mix(a: Rgb, b: Rgb, t: f64) -> Rgb {
    if t <= 0.0 {
        return a;
    }
    if t >= 1.0 {
        return b;
    }
    let (a, b) = (oklab(a), oklab(b));
    srgb(std::array::from_fn(|k| a[k] + t * (b[k] - a[k])))
}

fn oklab(c: Rgb) -> [f64; 3] {
    let [r, g, b] = c.map(|byte| {
        let s = f64::from(byte) / 255.0;
        if s <= 0.04045 { s / 12.92 } else { libm::pow((s + 0.055) / 1.055, 2.4) }
    });
    let l = libm::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    let m = libm::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    let s = libm::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    [
        0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
        1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
        0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s,
    ]
}

fn srgb([lightness, a, b]: [f64; 3]) -> Rgb {
    let l = (lightness + 0.3963377774 * a + 0.2158037573 * b).powi(3);
    let m = (lightness - 0.1055613458 * a - 0.0638541728 * b).powi(3);
    let s = (lightness - 0.0894841775 * a - 1.2914855480 * b).powi(3);
    let linear = [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s,
    ];
    linear.map(|x| {
        let v = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::pow(x, 1.0 / 2.4) - 0.055 };
        (255.0 * v.clamp(0.0, 1.0)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nine_bands_are_the_anchors() {
        for (name, anchors) in [("inspect", INSPECT), ("safe", SAFE), ("mono", MONO)] {
            assert_eq!(colors(name, 9), anchors.map(bytes));
        }
    }

    #[test]
    fn any_number_of_bands_keeps_ends_and_middle() {
        for bands in [3, 5, 7, 11, 15] {
            let c = colors("inspect", bands);
            assert_eq!(c.len(), bands + 2);
            assert_eq!([c[0], c[1], c[bands / 2 + 1], c[bands], c[bands + 1]], {
                let a = INSPECT.map(bytes);
                [a[0], a[1], a[5], a[9], a[10]]
            });
        }
    }

    #[test]
    fn oklab_goes_there_and_back() {
        for c in [[0, 0, 0], [255, 255, 255], [47, 168, 74], [211, 32, 31], [27, 47, 208]] {
            assert_eq!(srgb(oklab(c)), c);
        }
    }

    #[test]
    fn a_gray_between_grays_is_gray() {
        let [r, g, b] = mix([0, 0, 0], [255, 255, 255], 0.5);
        // OKLab lightness 0.5 is linear 0.125, sRGB byte 99.
        assert_eq!((r, g, b), (99, 99, 99));
    }
}
