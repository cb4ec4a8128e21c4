/** The address of a worker's script once it has been built. */
declare module "*?worker&url" {
  const url: string;
  export default url;
}

/** A style sheet as text. */
declare module "*.css?inline" {
  const text: string;
  export default text;
}
