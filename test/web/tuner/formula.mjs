// SPDX-License-Identifier: MIT
// The frequency response of a lag with dead time behind a hold, under a sampled PI, by its
// formula: what the page's margins are held against. No code of the page is in it.

// { size, angle } at w radians per step; the gain is in counts per count, lag and dead time
// in seconds, kp and ki (per step) as well. The angle goes on below -180 degrees.
export function loopByFormula({ gain, lag, dead, rate }, { kp, ki }, w) {
    const steps = Math.floor(dead * rate + 1e-9);
    const late = dead * rate - steps;
    const [all, some] = [Math.exp(-1 / rate / lag), Math.exp(-(1 - late) / rate / lag)];
    // gain (now + before / z) / (z - all) z^-steps (kp + ki z / (z - 1))
    const [now, before] = [1 - some, some - all];
    const half = ki / 2 / Math.tan(w / 2);
    const size = gain * Math.hypot(now + before * Math.cos(w), before * Math.sin(w)) / Math.hypot(Math.cos(w) - all, Math.sin(w)) * Math.hypot(kp + ki / 2, half);
    const angle = Math.atan2(-before * Math.sin(w), now + before * Math.cos(w)) - Math.atan2(Math.sin(w), Math.cos(w) - all) - steps * w - Math.atan2(half, kp + ki / 2);
    return { size, angle };
}

export function msByFormula(plant, gains, points = 20000) {
    let most = 0;
    for (let i = 1; i <= points; i++) {
        const { size, angle } = loopByFormula(plant, gains, Math.PI * i / points);
        most = Math.max(most, 1 / Math.sqrt(1 + 2 * size * Math.cos(angle) + size * size));
    }
    return most;
}
