/** The last word of a profile in the address, if hidden points of its strip belong to it. */
export const THROUGH = "through";
