// The arrow of a force.

/** Length of the head, as drawn [m]. */
const HEAD_M = 0.06;

type Place = readonly [x: number, y: number];

/** The path of an arrow from a place, along a vector, on the screen, where y points down [m]. */
export function arrow(from: Place, [x, y]: Place): string {
  const to: Place = [from[0] + x, from[1] + y];
  const length = HEAD_M / (Math.hypot(x, y) || 1);
  const wing = (turn: number): Place => [to[0] - length * (x - turn * y), to[1] - length * (y + turn * x)];
  const place = ([a, b]: Place): string => `${a.toFixed(3)} ${b.toFixed(3)}`;
  return `M${place(from)}L${place(to)}M${place(wing(0.5))}L${place(to)}L${place(wing(-0.5))}`;
}
