//! Rules of numerical integration.

/// Weights of a rule of Gauss and Legendre on −1 to 1, with their places. Exact for polynomials up to the degree `2·count − 1`.
pub fn gauss(count: usize) -> Vec<[f64; 2]> {
    let n = count as f64;
    let legendre = |x: f64| {
        let (mut before, mut value) = (1.0, x);
        for k in 2..=count {
            let k = k as f64;
            (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
        }
        (value, n * (x * value - before) / (x * x - 1.0))
    };
    (0..count)
        .map(|i| {
            let mut x = libm::cos(std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5));
            // Newton's method doubles its digits at each step, from three.
            for _ in 0..6 {
                let (value, slope) = legendre(x);
                x -= value / slope;
            }
            let slope = legendre(x).1;
            [x, 2.0 / ((1.0 - x * x) * slope * slope)]
        })
        .collect()
}

/// Places of the rule of Gauss and Kronrod with 21 places, from the outermost one to the middle; those of odd number are of the
/// rule of Gauss with 10. (Piessens et al., QUADPACK, 1983.)
const PLACES: [f64; 11] = [
    0.995_657_163_025_808_1,
    0.973_906_528_517_171_7,
    0.930_157_491_355_708_2,
    0.865_063_366_688_984_5,
    0.780_817_726_586_416_9,
    0.679_409_568_299_024_4,
    0.562_757_134_668_604_7,
    0.433_395_394_129_247_2,
    0.294_392_862_701_460_2,
    0.148_874_338_981_631_22,
    0.0,
];
/// Weights of all 21.
const KRONROD: [f64; 11] = [
    0.011_694_638_867_371_874,
    0.032_558_162_307_964_725,
    0.054_755_896_574_352,
    0.075_039_674_810_919_96,
    0.093_125_454_583_697_6,
    0.109_387_158_802_297_64,
    0.123_491_976_262_065_85,
    0.134_709_217_311_473_34,
    0.142_775_938_577_060_09,
    0.147_739_104_901_338_49,
    0.149_445_554_002_916_9,
];
/// Weights of the 10.
const GAUSS: [f64; 5] = [
    0.066_671_344_308_688_14,
    0.149_451_349_150_580_6,
    0.219_086_362_515_982_04,
    0.269_266_719_309_996_35,
    0.295_524_224_714_752_87,
];

/// An integral over a range, and by how much a weaker rule differs: far more than it is off where the integrand is smooth.
#[derive(Clone, Copy)]
pub struct Part<const N: usize> {
    pub range: [f64; 2],
    pub sum: [f64; N],
    pub error: [f64; N],
}

/// By the rule of Gauss and Kronrod.
pub fn kronrod<const N: usize>(range: [f64; 2], value: &impl Fn(f64) -> [f64; N]) -> Part<N> {
    let (middle, half) = (0.5 * (range[0] + range[1]), 0.5 * (range[1] - range[0]));
    let (mut sum, mut weak) = ([0.0; N], [0.0; N]);
    for (i, x) in PLACES.iter().enumerate() {
        let sides: &[f64] = if *x == 0.0 { &[1.0] } else { &[-1.0, 1.0] };
        for side in sides {
            let own = value(middle + side * half * x);
            for n in 0..N {
                sum[n] += half * KRONROD[i] * own[n];
                if i % 2 == 1 {
                    weak[n] += half * GAUSS[i / 2] * own[n];
                }
            }
        }
    }
    Part { range, sum, error: std::array::from_fn(|n| (sum[n] - weak[n]).abs()) }
}

/// Halves the part with the greatest share of its error until the errors of all together are no more than what is asked for, or `most`
/// parts are there. `owner` says for each part the first argument of the integrand.
pub fn adaptive<const N: usize>(
    mut parts: Vec<Part<N>>,
    asked: [f64; N],
    most: usize,
    value: &impl Fn(usize, f64) -> [f64; N],
    mut owner: Vec<usize>,
) -> ([f64; N], [f64; N]) {
    let worst = |p: &Part<N>| (0..N).map(|n| p.error[n] / asked[n]).fold(0.0, f64::max);
    let mut total: [f64; N] = std::array::from_fn(|n| parts.iter().map(|p| p.error[n]).sum());
    let mut open: std::collections::BinaryHeap<(u64, usize)> =
        parts.iter().enumerate().map(|(i, p)| (worst(p).to_bits(), i)).collect();
    while parts.len() < most && (0..N).any(|n| total[n] > asked[n]) {
        let Some((_, i)) = open.pop() else { break };
        let [a, b] = parts[i].range;
        let middle = 0.5 * (a + b);
        if !(a < middle && middle < b) {
            continue;
        }
        let piece = owner[i];
        let of = |t: f64| value(piece, t);
        let halves = [kronrod([a, middle], &of), kronrod([middle, b], &of)];
        for (n, sum) in total.iter_mut().enumerate() {
            *sum += halves[0].error[n] + halves[1].error[n] - parts[i].error[n];
        }
        let [first, second] = halves;
        parts[i] = first;
        parts.push(second);
        owner.push(piece);
        open.push((worst(&parts[i]).to_bits(), i));
        open.push((worst(&parts[parts.len() - 1]).to_bits(), parts.len() - 1));
    }
    let (mut sum, mut error) = ([0.0; N], [0.0; N]);
    for part in &parts {
        for n in 0..N {
            sum[n] += part.sum[n];
            error[n] += part.error[n];
        }
    }
    (sum, error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_exact_for_polynomials_of_their_degree() {
        for count in [1, 2, 4, 10, 16] {
            let rule = gauss(count);
            for power in 0..2 * count as i32 {
                let sum: f64 = rule.iter().map(|[x, w]| w * x.powi(power)).sum();
                let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((sum - exact).abs() < 1e-14, "{count} {power} {sum}");
            }
        }
        for power in 0..=31 {
            let part = kronrod([0.0, 1.0], &|x: f64| [x.powi(power)]);
            assert!((part.sum[0] - 1.0 / f64::from(power + 1)).abs() < 1e-15, "{power}");
            assert!(power > 19 || part.error[0] < 1e-15, "{power}");
        }
    }

    #[test]
    fn creases_are_found() {
        let value = |_: usize, x: f64| [(x - 0.3).abs()];
        let parts = vec![kronrod([0.0, 1.0], &|x| value(0, x))];
        let (sum, error) = adaptive(parts, [1e-12], 1000, &value, vec![0]);
        assert!((sum[0] - 0.29).abs() < 1e-12 && error[0] <= 1.001e-12);
    }
}
