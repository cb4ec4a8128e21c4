import { button, make, numberField } from "../tools/make.ts";

/** Asks which columns of a table are x, y and z, and calls `choose` with them. `at`: the columns that were taken. */
export function chooseColumns(at: readonly number[], choose: (columns: [string, string, string]) => void): void {
  const fields = ["x", "y", "z"].map((axis, i) => {
    const { row, input } = numberField(`column-${axis}`, `Column of ${axis}`);
    Object.assign(input, { min: "1", step: "1", required: true, value: String(at[i]) });
    return { row, input };
  });
  const form = make(
    "form",
    { method: "dialog" },
    ...fields.map(({ row }) => row),
    make("div", { class: "buttons" }, make("button", {}, "Open with these"), button("Close", close)),
  );
  const title = make("h2", { id: "columns-title" }, "Which columns are x, y and z?");
  const dialog = make("dialog", { id: "columns", "aria-labelledby": "columns-title" }, title, form);
  form.addEventListener("submit", () => choose(fields.map(({ input }) => input.value) as [string, string, string]));
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();

  function close(): void {
    dialog.close();
  }
}
