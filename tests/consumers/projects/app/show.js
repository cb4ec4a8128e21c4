// Writes the answer, or the error, where the test reads it: into the page.
export async function show(asking) {
  const output = document.querySelector("output");
  try {
    output.textContent = JSON.stringify(await asking);
  } catch (error) {
    output.textContent = JSON.stringify({ error: `${error.code ?? error.name}: ${error.message}` });
  }
  output.dataset.done = "";
}
