/** The library has answered wrongly. A time counts only with the right answer, so this ends the run. */
export class WrongAnswer extends Error {
  override name = "WrongAnswer";
}
