/** What is drawn is wrong; the message is that of the judge. */
export class AssertionError extends Error {}

/** Width and height, in pixels. */
export type Window = readonly [width: number, height: number];
/** How often each pixel is drawn, row by row; of booleans it cannot be seen whether a pixel is drawn twice. */
export type Mask =
  | Uint8Array | Uint8ClampedArray | Uint16Array | Uint32Array | Int8Array | Int16Array | Int32Array | boolean[] | number[];

export interface Options {
  /** Cases of each family; 50 where it is not given. */
  cases?: number;
  /** Decides every generated case; 1 where it is not given. */
  seed?: number;
  /** Only this family, or these. */
  family?: string | string[];
  /** Only the case of this number. */
  case?: number;
  /** Words of the line protocol for what the function promises, such as "rule=strict winding=cw range=4096". */
  declare?: string;
  /** So many seconds for cases, for making failing ones smaller, and for their cause. */
  seconds?: number;
  /** Whether a mask of 0 and a number above 1 counts how often a pixel is drawn; refused where it is not given. */
  hits?: boolean;
}

/** Judges which pixels of triangles are drawn: a mask, or a list of spans, each row, first column, one past the last. */
export function assertRasterizer(
  fn: (corners: [x: number, y: number][], window: Window) => Mask | [y: number, x0: number, x1: number][] | number[][],
  options?: Options,
): void;

/** Judges which pixels of lines are drawn: a mask, or a list of pixels in drawing order, those outside left out. */
export function assertLines(
  fn: (ends: [x: number, y: number][], window: Window) => Mask | [x: number, y: number][] | number[][],
  options?: Options,
): void;

/**
 * Judges the triangles that are made of polygons: they cover each exactly once. The function gets contours, the first one
 * of a polygon around the others, and returns null for a polygon that it does not take.
 */
export function assertPartition(
  fn: (contours: [x: number, y: number][][]) => [x: number, y: number][][] | number[][][] | null,
  options?: Options,
): void;

/** Judges pixels with their values: z, linear on the screen, and a b in perspective, three numbers for each pixel. */
export function assertValues(
  fn: (
    corners: [x: number, y: number, z: number, w: number, a: number, b: number][],
    window: Window,
  ) => { mask: Mask; values: Float64Array | Float32Array },
  options?: Options,
): void;
