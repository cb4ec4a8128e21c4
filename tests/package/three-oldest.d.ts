/** The oldest three.js that the adapter supports; its types are close enough to the newest's. */
declare module "three-oldest" {
  export * from "three";
}
