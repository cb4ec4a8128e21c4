// Writes what was answered, or what went wrong, where the test reads it: into the page, or,
// from a browser that nothing drives, to the server.
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
