/** The oldest three.js that the adapter supports. The types of the newest version are close enough. */
declare module "three-oldest" {
  export * from "three";
}
