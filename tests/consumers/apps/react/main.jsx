import { Canvas } from "@react-three/fiber";
import { init, PointCloud } from "hidden-point-removal";
import { useHiddenPointFilter } from "hidden-point-removal/react-three-fiber";
import { useRef } from "react";
import { createRoot } from "react-dom/client";
import { positions, viewpoint } from "./shared/answer.js";
import { show } from "./shared/show.js";

const all = positions();

/** The points that the canvas draws, once the exact answer of a worker is drawn. */
function Cloud({ onDrawn, onError }) {
  const points = useRef(null);
  const filter = useHiddenPointFilter(points, {
    onChange: ({ answer }) => {
      if (answer !== "draft") onDrawn([...filter.visible]);
    },
    onError,
  });
  return (
    <points ref={points}>
      <bufferGeometry>
        <bufferAttribute attach="attributes-position" args={[all, 3]} />
      </bufferGeometry>
      <pointsMaterial size={0.05} />
    </points>
  );
}

const drawn = new Promise((resolve, reject) => {
  createRoot(document.querySelector("#app")).render(
    <Canvas frameloop="demand" camera={{ position: viewpoint }}>
      <Cloud onDrawn={resolve} onError={reject} />
    </Canvas>,
  );
});

async function ask() {
  await init();
  const here = [...new PointCloud(all).visibleFrom(viewpoint).indices];
  return { here, there: await drawn };
}

void show(ask());
