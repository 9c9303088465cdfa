// SPDX-License-Identifier: MIT
// One sentence and a link for what the page shows: below it while “Explain” is pressed.
import { make } from './dom.js';

// [sentence, document and heading].
export const HELP = {
    SETPOINT: ['The value that the measurement should reach.', 'scaling#three-questions'],
    KP: ['Counts of output for each count of error.', 'scaling#three-questions'],
    KI: ['How fast the output grows while an error stays: kp divided by Ti.', 'scaling#three-questions'],
    KD: ['Output against the speed of the measurement: kp times Td.', 'scaling#three-questions'],
    calm: ['Moves kp, ki and kd together by Skogestad’s rules for this plant, from a slow loop with much margin to a quick one with little.', 'tuning#calm-to-quick'],
    wish: ['Finds the quickest gains on this slider with the Ms that you enter.', 'tuning#calm-to-quick'],
    FILTER: ['Smooths the derivative, which amplifies noise, over about this many steps.', 'controller#what-each-feature-does'],
    WEIGHT: ['The share of the setpoint that P sees: a smaller one softens a setpoint change and leaves the response to a load unchanged.', 'scaling#a-setpoint-weight-below-1'],
    GAIN: ['How far full drive moves the measurement, or how fast.', 'tuning#the-oven-by-itself'],
    T1: ['The time in which the plant has gone about two thirds of its way.', 'tuning#the-oven-by-itself'],
    T2: ['A second, shorter lag, such as that of an element or a sensor.', 'tuning#the-oven-by-itself'],
    DEAD: ['The time before a change of the output has any effect on the measurement.', 'tuning#the-oven-by-itself'],
    DAMPING: ['How fast a swing dies out: 1 does not swing, 0.1 swings for long.', 'tuners#random-plants'],
    START: ['What is measured while the output is 0.', 'scaling#three-questions'],
    SENSOR_BITS: ['The bits of the converter: 10 bits are counts from 0 to 1023.', 'scaling#three-questions'],
    SENSOR_LOW: ['The measurement at count 0.', 'scaling#three-questions'],
    SENSOR_RANGE: ['The measurement from the first count to the last.', 'scaling#three-questions'],
    NOISE: ['The largest distance of a conversion from the true value.', 'scaling#three-questions'],
    OUTPUT_MIN: ['The lowest count that your actuator takes.', 'scaling#three-questions'],
    OUTPUT_MAX: ['The highest count that your actuator takes, such as 255 of a PWM of 8 bits.', 'scaling#three-questions'],
    RATE: ['How often your firmware calls the step.', 'scaling#three-questions'],
    INTEGRAL_MIN: ['The lowest value of the integral; 0 and 0 leave it to the limits of the output.', 'controller#what-each-feature-does'],
    INTEGRAL_MAX: ['The highest value of the integral, or of AN937’s accumulated error.', 'controller#what-each-feature-does'],
    DURATION: ['The length of time that the plots show.', 'tuning#tuning'],
    SWING: ['How far the experiment lets the measurement swing at most; 0 is an eighth of the converter’s range.', 'tuning#by-a-relay'],
    CYCLES: ['How many swings are measured; 1 is enough.', 'tuning#by-a-relay'],
    DRIVE: ['The output of a heat-up; if full output would go too far, half of it may do.', 'tuning#the-oven-by-itself'],
    ROBUSTNESS: ['How much the plant may change before the loop swings: more is calmer.', 'tuning#quick-safe-and-calm'],
    'reverse acting': ['More output makes the measurement fall, as in a refrigerator.', 'controller#what-each-feature-does'],
    'derivative on the error': ['D also sees a setpoint change, and kicks.', 'controller#what-each-feature-does'],
    'P on the measurement': ['P does not see the setpoint at all: no kick, and a slower rise.', 'controller#what-each-feature-does'],
    Overshoot: ['How far the first step goes beyond its setpoint, as a part of the step.', 'controller#beside-double-precision'],
    Settled: ['When the first step stays within 2 % of its height, or within the noise.', 'controller#beside-double-precision'],
    Load: ['The largest error after the first load.', 'controller#beside-double-precision'],
    Ms: ['The largest factor by which the loop amplifies a disturbance: 1.4 is calm, above 2 is little margin.', 'tuners#how-a-loop-is-judged'],
    'Phase margin': ['How much more phase lag the loop tolerates before it oscillates.', 'tuners#how-a-loop-is-judged'],
    'Base’s way': ['How far the base goes from where it began.', 'tuning#the-pendulum-by-the-steps-of-an964'],
    Shove: ['The largest angle after the shove.', 'tuning#the-pendulum-by-the-steps-of-an964'],
    'Baud rate': ['The speed of the board’s UART, as its program has set it.', 'link#on-the-tuner-page'],
    'Board’s setpoint': ['A whole number of the counts that the board measures in, within the range of its program.', 'link#on-the-tuner-page'],
    'Step of': ['How far the setpoint or the output goes from where it is, and back at the end.', 'link#on-the-tuner-page'],
    'Recorded for': ['How long the step is recorded: several times as long as the plant takes.', 'link#on-the-tuner-page'],
};

// The documents stand beside the page on the site, and above it in the sources.
export function documentOf(link, location) {
    const [name, heading] = link.split('#');
    return location.href.includes('/build/tuner/') ? `../../docs/${name}.md#${heading}` : `../docs/${name}.html#${heading}`;
}

// The sentence for what has one, or nothing.
export function helpFor(key) {
    const [sentence, link] = HELP[key] ?? [];
    return link === undefined ? '' : make('small', { className: 'help' }, `${sentence} `, make('a', { href: documentOf(link, location), textContent: 'More' }));
}

// Shows all of them, or none.
export function listenForHelp(button) {
    button.addEventListener('click', () => button.setAttribute('aria-pressed', String(document.body.classList.toggle('explains'))));
}
