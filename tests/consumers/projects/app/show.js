// Writes the answer, or the error, where the test reads it: into the page. A browser that the
// test cannot drive sends it to the server.
export async function show(asking) {
  const output = document.querySelector("output");
  try {
    output.textContent = JSON.stringify(await asking);
  } catch (error) {
    output.textContent = JSON.stringify({ error: `${error.code ?? error.name}: ${error.message}` });
  }
  output.dataset.done = "";
  const { sendTo } = output.dataset;
  if (sendTo !== undefined) await fetch(sendTo, { method: "POST", body: output.textContent });
}
